// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pose_search.hpp"

#include <algorithm>
#include <cmath>

#include "registration/deskew.hpp"

namespace lego_loam_sc {
namespace {

// Points of each set that judge a pose of the grid. Scattered points and edges see motions in all
// directions, the planar ones are mostly on the ground.
constexpr int kPlanars = 60;
constexpr int kEdges = 60;
constexpr int kScattered = 120;
// m; the agreement is by distance alone.
constexpr double kAnyNoise = 1.0;
// Step of the grid in voxels, and of the yaw, rad.
constexpr double kStepVoxels = 2.0;
constexpr double kYawStep = 0.07;

bool apart(const Pose& a, const Pose& b, double step) {
  return (a.translation() - b.translation()).norm() > 1.5 * step ||
         rotation_angle(a.inverse() * b) > 1.5 * kYawStep;
}

}  // namespace

double agreement(LocalMap& map, const Features& points, const Pose& T_map_lidar, double tolerance) {
  MatchedSurfaces cache;
  const double max_distance = 4.0 * tolerance;
  double sum = 0.0;
  for (const Correspondence& c :
       map.match(points, T_map_lidar, max_distance, kAnyNoise, 0, cache).all) {
    const double d = distance(c, T_map_lidar) / tolerance;
    sum += 1.0 / (1.0 + d * d);
  }
  const std::size_t count =
      points.planars_large.size() + points.edges_large.size() + points.scattered.size();
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

std::vector<ScoredPose> search_poses(LocalMap& map, const Features& points,
                                     const Pose& T_map_previous, double seconds,
                                     const PoseSearchRange& range, double voxel_size, int count) {
  Features sample;
  sample.planars_large = subsample(points.planars_large, kPlanars);
  sample.edges_large = subsample(points.edges_large, kEdges);
  sample.scattered = subsample(points.scattered, kScattered);
  const double step = kStepVoxels * voxel_size;
  const int steps = static_cast<int>(std::ceil(range.distance / step));
  const int turns = static_cast<int>(std::ceil(range.yaw / kYawStep));

  std::vector<ScoredPose> poses;
  for (int turn = -turns; turn <= turns; ++turn) {
    for (int i = -steps; i <= steps; ++i) {
      for (int j = -steps; j <= steps; ++j) {
        if (i * i + j * j > steps * steps) continue;
        Pose motion = Pose::Identity();
        motion.translation() << i * step, j * step, 0.0;
        motion.linear() = rotation_from_rpy(0.0, 0.0, turn * kYawStep);
        const Pose pose = T_map_previous * motion;
        const Features deskewed = deskew(sample, log_se3(motion) / seconds);
        poses.push_back({pose, agreement(map, deskewed, pose, 0.5 * step)});
      }
    }
  }
  std::stable_sort(poses.begin(), poses.end(),
                   [](const ScoredPose& a, const ScoredPose& b) { return a.score > b.score; });
  std::vector<ScoredPose> best;
  for (const ScoredPose& pose : poses) {
    if (static_cast<int>(best.size()) == count) break;
    if (std::all_of(best.begin(), best.end(), [&](const ScoredPose& other) {
          return apart(pose.T_map_lidar, other.T_map_lidar, step);
        }))
      best.push_back(pose);
  }
  return best;
}

}  // namespace lego_loam_sc
