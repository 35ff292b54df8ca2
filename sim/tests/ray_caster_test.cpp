// SPDX-License-Identifier: BSD-3-Clause
#include "sim/ray_caster.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

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

TEST(SimRayCaster, AFanOfRaysMeetsWhatEachRayMeetsAlone) {
  Mesh mesh;
  for (int i = 0; i < 40; ++i)
    add_box(mesh, Pose(Eigen::Translation3d(3.0 + i % 7, 0.7 * i - 14.0, -1.0)),
            {0.4, 0.5, 1.0 + 0.05 * i}, 0.5);
  const RayCaster world(mesh);
  const Vector3d origin(0.1, 0.2, 0.3);
  std::vector<Vector3d> directions;
  for (int i = 0; i < 101; ++i)  // not a whole number of packets
    directions.push_back(Vector3d(1.0, 0.04 * i - 2.0, -0.05 + 0.001 * i).normalized());
  std::vector<std::optional<Hit>> hits(directions.size());
  world.cast(origin, directions, 12.0, hits);
  int met = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const auto alone = world.cast(origin, directions[i], 12.0);
    ASSERT_EQ(hits[i].has_value(), alone.has_value()) << i;
    if (!alone) continue;
    ++met;
    EXPECT_EQ(hits[i]->range, alone->range);
    EXPECT_EQ(hits[i]->cos_incidence, alone->cos_incidence);
  }
  EXPECT_GT(met, 30);
  EXPECT_LT(met, 101);
}

TEST(SimRayCaster, AnEmptyWorldReturnsNothing) {
  EXPECT_FALSE(RayCaster(Mesh{}).cast(Vector3d::Zero(), Vector3d::UnitX(), 100.0));
}

}  // namespace
}  // namespace lego_loam_sc
