// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/observability.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "made_scenes.hpp"
#include "mapping/pose_search.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kNoise = 0.02;
constexpr double kVoxel = 0.25;

Features features_at(const Scene& scene, const Pose& T_world_lidar, std::uint64_t seed) {
  const SensorModel sensor = made_sensor(900);
  const Scan scan = take_scan(scene, sensor, T_world_lidar, {.noise = kNoise, .seed = seed});
  return through_stages(scan, sensor, kMadeHeight).features;
}

// A map of scans along x and a further scan, which takes no part in it.
struct Mapped {
  LocalMap map{kVoxel, 3, 0.1};
  Pose truth = pose_of(0.9, 0.0, kMadeHeight, 0.0);
  Features features;

  explicit Mapped(const Scene& scene) {
    for (int k = 0; k < 8; ++k) {
      const Pose at = pose_of(-3.0 + 0.5 * k, 0.0, kMadeHeight, 0.0);
      map.insert(features_at(scene, at, static_cast<std::uint64_t>(k + 1)), at);
    }
    features = features_at(scene, truth, 77);
  }

  Observability along(const Eigen::Vector3d& direction) {
    Vector6 step = Vector6::Zero();
    step.head<3>() = kVoxel * direction;
    return observability(map, features, truth, step, kNoise);
  }
};

// Two walls, floor and ceiling along x, without end.
Scene endless_corridor() {
  Scene scene;
  scene.plane({0, 0, 0}, Eigen::Vector3d::UnitZ());
  scene.plane({0, 0, 4}, -Eigen::Vector3d::UnitZ());
  scene.plane({0, 2.5, 0}, -Eigen::Vector3d::UnitY());
  scene.plane({0, -2.5, 0}, Eigen::Vector3d::UnitY());
  return scene;
}

TEST(Observability, AStreetIsObservedInAllDirections) {
  Mapped mapped(street());
  for (int axis = 0; axis < 3; ++axis) {
    const Observability o = mapped.along(Eigen::Vector3d::Unit(axis));
    EXPECT_GT(o.significance, 6.0) << axis;
    EXPECT_LT(o.standard_error * kVoxel, 0.05) << axis;
  }
}

TEST(Observability, ACorridorWithoutEndIsNotObservedAlongItself) {
  Mapped mapped(endless_corridor());
  EXPECT_LT(mapped.along(Eigen::Vector3d::UnitX()).significance, 4.0);
  EXPECT_GT(mapped.along(Eigen::Vector3d::UnitY()).significance, 10.0);
  EXPECT_GT(mapped.along(Eigen::Vector3d::UnitZ()).significance, 10.0);
}

TEST(PoseSearch, FindsAMotionThatNothingHasPredicted) {
  Mapped mapped(street());
  const Pose previous = pose_of(0.9 - 2.6, 0.3, kMadeHeight, 6.0);
  const std::vector<ScoredPose> found =
      search_poses(mapped.map, mapped.features, previous, 0.1, {4.0, 0.35}, kVoxel, 5);
  ASSERT_EQ(found.size(), 5u);
  bool near = false;
  for (const ScoredPose& pose : found) {
    const Pose error = mapped.truth.inverse() * pose.T_map_lidar;
    near |= error.translation().norm() < 0.6 && rotation_angle(error) < 0.07;
  }
  EXPECT_TRUE(near);
  EXPECT_GT(agreement(mapped.map, mapped.features, mapped.truth, kVoxel),
            agreement(mapped.map, mapped.features, previous, kVoxel));
}

}  // namespace
}  // namespace lego_loam_sc
