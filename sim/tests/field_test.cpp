// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "sim/ray_caster.hpp"
#include "sim/world.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t second = 1'000'000'000;

TEST(SimField, IsDrivenOnceRoundBackToItsStart) {
  const Motion motion = make_world("field", 1).motion;
  double length = 0.0;
  for (std::int64_t t = 0; t < motion.duration_ns; t += second / 10)
    length += (motion.pose(t + second / 10).translation() - motion.pose(t).translation()).norm();
  EXPECT_GT(length, 300.0);
  EXPECT_LT(length, 400.0);
  const Pose change = motion.pose(0).inverse() * motion.pose(motion.duration_ns);
  EXPECT_LT(change.translation().norm(), 1e-9);
  EXPECT_LT(rotation_angle(change), 1e-9);
}

TEST(SimField, IsOpenWithAFewTreesWithinSight) {
  const World world = make_world("field", 1);
  const RayCaster caster(world.mesh);
  for (std::int64_t t = 0; t < world.motion.duration_ns; t += 10 * second) {
    const Vector3d sensor = world.motion.pose(t) * Vector3d(0, 0, world.sensor_height);
    const auto sees_tree = [&](int tenth_deg) {
      const double azimuth = radians(0.1 * tenth_deg);
      for (const double elevation_deg : {4.0, 5.0, 6.0}) {
        const double elevation = radians(elevation_deg);
        const Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                 std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        if (caster.cast(sensor, direction, 100.0)) return true;
      }
      return false;
    };
    // A tree is a run of directions with a gap of more than a degree before it.
    int trees = 0, covered = 0, since = 100;
    for (int tenth_deg = 0; tenth_deg < 3600; ++tenth_deg, ++since) {
      if (!sees_tree(tenth_deg)) continue;
      trees += since > 10;
      ++covered;
      since = 0;
    }
    EXPECT_GE(trees, 4) << "at " << sensor.transpose();
    EXPECT_LE(trees, 30) << "at " << sensor.transpose();
    EXPECT_LT(covered, 900) << "at " << sensor.transpose();
  }
}

}  // namespace
}  // namespace lego_loam_sc
