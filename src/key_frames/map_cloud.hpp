// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/map_point.hpp"
#include "core/pose.hpp"
#include "key_frames/key_frames.hpp"

namespace lego_loam_sc {

/// The map: the points of all key frames at their poses, one for each voxel of `voxel_size` (m).
/// In the map frame and in the order of the key frames; a voxel belongs to the first that saw it.
std::vector<MapPoint> make_map(const KeyFrames& key_frames, std::span<const Pose> T_map_key,
                               double voxel_size);

/// The same piece by piece: gives `take` the points of one key frame after the other.
void make_map(const KeyFrames& key_frames, std::span<const Pose> T_map_key, double voxel_size,
              const std::function<void(std::span<const MapPoint>)>& take);

/// All points of one key frame in its own LiDAR frame, as the map takes them.
std::vector<MapPoint> points_of(const KeyFrame& key_frame, std::int32_t number);

}  // namespace lego_loam_sc
