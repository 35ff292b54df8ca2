// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "io/trajectory.hpp"

namespace lego_loam_sc {

/// The poses of two trajectories at the same time, each in its own map frame.
struct PosePair {
  Pose truth = Pose::Identity();
  Pose estimate = Pose::Identity();
};

/// Pairs in ascending order of time. With stamps, each pose of the shorter trajectory is paired
/// with the nearest of the other within 0.01 s (the earlier of two equally near ones); otherwise
/// poses are paired by index, and a KITTI estimate may be shorter than its KITTI truth. Throws
/// InputError when stamps do not ascend, counts do not match or fewer than two pairs are found.
std::vector<PosePair> associate(const PoseFile& truth, const PoseFile& estimate);

}  // namespace lego_loam_sc
