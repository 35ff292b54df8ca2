// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "sim/ray_caster.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

TEST(SimRayCaster, FindsTheNearestSurfaceFromEitherSideOrNothing) {
  Mesh mesh;
  const auto wall = [&](double x, double reflectivity) {
    add_quad(mesh, {Vector3d(x, -1, -1), Vector3d(x, 1, -1), Vector3d(x, 1, 1), Vector3d(x, -1, 1)},
             reflectivity);
  };
  wall(5.0, 0.25);
  wall(3.0, 0.75);
  const RayCaster world(mesh);
  const auto near = world.cast(Vector3d::Zero(), Vector3d::UnitX(), 100.0);
  ASSERT_TRUE(near);
  EXPECT_DOUBLE_EQ(near->range, 3.0);
  EXPECT_DOUBLE_EQ(near->cos_incidence, 1.0);
  EXPECT_FLOAT_EQ(near->reflectivity, 0.75);
  const auto behind = world.cast(Vector3d(9.0, 0.0, 0.0), -Vector3d::UnitX(), 100.0);
  ASSERT_TRUE(behind);
  EXPECT_DOUBLE_EQ(behind->range, 4.0);
  EXPECT_FALSE(world.cast(Vector3d::Zero(), Vector3d::UnitX(), 2.9));
  EXPECT_FALSE(world.cast(Vector3d::Zero(), Vector3d::UnitZ(), 100.0));
}

TEST(SimRayCaster, RangesKeepTheirPrecisionFarFromTheOrigin) {
  Mesh mesh;
  const double x = 4096.5, y = -2048.25;  // exact in single precision
  add_quad(mesh,
           {Vector3d(x, y - 9, -9), Vector3d(x, y + 9, -9), Vector3d(x, y + 9, 9),
            Vector3d(x, y - 9, 9)},
           0.5);
  const RayCaster world(mesh);
  const Vector3d direction = Vector3d(1.0, 0.3, -0.2).normalized();
  const auto hit = world.cast(Vector3d(x - 3.00001, y, 0.0), direction, 100.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range, 3.00001 / direction.x(), 1e-9);
  EXPECT_NEAR(hit->cos_incidence, direction.x(), 1e-12);
}

TEST(SimRayCaster, AnEmptyWorldReturnsNothing) {
  EXPECT_FALSE(RayCaster(Mesh{}).cast(Vector3d::Zero(), Vector3d::UnitX(), 100.0));
}

}  // namespace
}  // namespace lego_loam_sc
