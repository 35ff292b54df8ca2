// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/arch.hpp"
#include "sim/noise.hpp"
#include "sim/random.hpp"
#include "sim/ray_caster.hpp"
#include "sim/roadway.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;

TEST(SimNoise, FillsItsRangeEvenly) {
  Random random(5);
  double sum = 0.0, highest = -1.0, lowest = 1.0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d place{random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50)};
    const double value = smooth_noise(place, 7);
    sum += value;
    highest = std::max(highest, value);
    lowest = std::min(lowest, value);
  }
  EXPECT_NEAR(sum / 4000.0, 0.0, 0.03);
  EXPECT_GT(highest, 0.7);
  EXPECT_LE(highest, 1.0);
  EXPECT_LT(lowest, -0.7);
  EXPECT_GE(lowest, -1.0);
}

TEST(SimNoise, HasContinuousSlopesAcrossItsCells) {
  const double h = 1e-4;
  for (const double edge : {-3.0, 0.0, 12.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3d place(0.3, -5.4, 2.7);
      place[axis] = edge;
      const Vector3d step = h * Vector3d::Unit(axis);
      const auto slope = [&](const Vector3d& from) {
        return (smooth_noise(from + step, 7) - smooth_noise(from, 7)) / h;
      };
      EXPECT_NEAR(slope(place - step), slope(place), 1e-2);
    }
  }
}

TEST(SimNoise, DependsOnItsSeed) {
  const Vector3d place(0.3, -5.4, 2.7);
  EXPECT_EQ(smooth_noise(place, 7), smooth_noise(place, 7));
  EXPECT_NE(smooth_noise(place, 7), smooth_noise(place, 8));
}

TEST(SimArch, PointsLieOnFloorWallsAndEllipse) {
  const Arch arch{.half_width = 2.6, .wall = 1.7, .rise = 2.0};
  const double left = arch.floor_angle();
  for (double angle = left - 1.5; angle < left + 2.0 * pi - 1.6; angle += 0.01) {
    const Vector2d p = arch.at(angle);
    if (angle < left || angle > pi - left) {
      EXPECT_NEAR(p.y(), 0.0, 1e-12);
      EXPECT_LE(std::abs(p.x()), 2.6);
    } else if (p.y() <= 1.7) {
      EXPECT_NEAR(std::abs(p.x()), 2.6, 1e-12);
      EXPECT_GE(p.y(), 0.0);
    } else {
      EXPECT_NEAR(std::hypot(p.x() / 2.6, (p.y() - 1.7) / 2.0), 1.0, 1e-12);
    }
  }
}

Rock rock() {
  return {.floor = [](double x, double y) { return 0.05 * x + 0.02 * y; }, .seed = 11};
}

TEST(SimRoadway, ContainsWhatLiesWithinItsRoughSurface) {
  const Roadway roadway({{0, 0}, {30, 10}, {60, 10}}, 5.0, 1.0, rock());
  for (const double distance : {8.0, 15.0, 45.0, 50.0}) {
    const Roadway::Axis axis = roadway.axis(distance);
    const Vector3d centre = axis.centre();
    for (double angle = -0.4; angle < pi + 0.4; angle += 0.1) {
      const Vector3d surface = roadway.wall(axis, angle);
      EXPECT_TRUE(roadway.contains(centre + 0.99 * (surface - centre), 0.0));
      EXPECT_FALSE(roadway.contains(centre + 1.01 * (surface - centre), 0.0));
      EXPECT_TRUE(roadway.contains(centre + 1.01 * (surface - centre), 0.1));
    }
  }
  EXPECT_FALSE(roadway.contains({-1.0, 0.0, 1.0}, 0.0));
  EXPECT_FALSE(roadway.contains({30.0, 20.0, 1.0}, 0.0));
}

TEST(SimRoadway, TwoThatMeetAreOneSpaceWithoutGaps) {
  Mesh mesh;
  const std::array<Roadway, 2> roadways = {Roadway({{-30, 0}, {30, 0}}, 5.0, 1.0, rock()),
                                           Roadway({{2, 0}, {4, 25}}, 5.0, 0.9, rock())};
  add_roadways(mesh, roadways);
  const RayCaster caster(mesh);
  double farthest = 0.0;
  for (const Vector3d& from :
       {Vector3d(2, 0, 1.5), Vector3d(-9, 0.5, 1.0), Vector3d(2.5, 6, 1.5)}) {
    for (double azimuth = 0.0; azimuth < 2.0 * pi; azimuth += 0.02) {
      for (double elevation = -1.5; elevation < 1.5; elevation += 0.05) {
        const auto hit =
            caster.cast(from, rotation_from_rpy(0.0, -elevation, azimuth).col(0), 100.0);
        ASSERT_TRUE(hit) << "a gap seen from " << from.transpose() << " at " << azimuth << ", "
                         << elevation;
        farthest = std::max(farthest, hit->range);
      }
    }
  }
  EXPECT_GT(farthest, 25.0);  // the side roadway is open
  EXPECT_LT(farthest, 42.0);  // all ends are closed
}

}  // namespace
}  // namespace lego_loam_sc
