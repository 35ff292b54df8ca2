// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "loop/key_frame.hpp"

namespace lego_loam_sc {

/// The map: the points of all key frames at their poses, one for each voxel of `voxel_size` (m).
/// x y z in the map frame (m) and intensity; in the order of the key frames.
std::vector<Eigen::Vector4f> make_map(std::span<const KeyFrame> key_frames,
                                      std::span<const Pose> T_map_key, double voxel_size);

}  // namespace lego_loam_sc
