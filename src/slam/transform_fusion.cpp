// SPDX-License-Identifier: BSD-3-Clause
#include "slam/transform_fusion.hpp"

namespace lego_loam_sc {

void TransformFusion::add(const TrackedScan& tracked) {
  if (tracked.status == Status::out_of_order) return;
  entries_.push_back({tracked.stamp_ns, tracked.last_key_frame, tracked.T_key_lidar});
  odometry_.push_back({tracked.stamp_ns, tracked.T_odom_lidar});
}

Trajectory TransformFusion::fuse(std::span<const Pose> T_map_key) const {
  Trajectory trajectory;
  trajectory.reserve(entries_.size());
  for (const Entry& entry : entries_)
    trajectory.push_back({entry.stamp_ns, T_map_key[entry.key_frame] * entry.T_key_lidar});
  return trajectory;
}

}  // namespace lego_loam_sc
