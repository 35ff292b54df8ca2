// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "io/trajectory.hpp"

namespace lego_loam_sc {

/// The same moment in two trajectories, each in its own map frame.
struct PosePair {
  Pose truth = Pose::Identity();
  Pose estimate = Pose::Identity();
};

/// Pairs in the order of time. With stamps, each pose of the shorter trajectory gets the other's
/// nearest within 0.01 s (of two equally near ones the earlier); without stamps in one of them,
/// poses are paired by index, and a KITTI estimate may end before its KITTI truth. Throws
/// InputError when stamps do not ascend, counts do not fit or fewer than two pairs are left.
std::vector<PosePair> associate(const PoseFile& truth, const PoseFile& estimate);

}  // namespace lego_loam_sc
