// SPDX-License-Identifier: BSD-3-Clause
#include "slam/transform_fusion.hpp"

namespace lego_loam_sc {

void TransformFusion::add(std::int64_t stamp_ns, int key_frame, const Pose& T_key_scan) {
  entries_.push_back({stamp_ns, key_frame, T_key_scan});
}

Trajectory TransformFusion::fuse(std::span<const Pose> T_map_key) const {
  Trajectory trajectory;
  trajectory.reserve(entries_.size());
  for (const Entry& entry : entries_)
    trajectory.push_back({entry.stamp_ns, T_map_key[entry.key_frame] * entry.T_key_scan});
  return trajectory;
}

}  // namespace lego_loam_sc
