// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "features/features.hpp"
#include "map/local_map.hpp"

namespace lego_loam_sc {

/// How far from the centre of a search a pose may be.
struct PoseSearchRange {
  double distance = 4.0;  ///< m, in the horizontal plane
  double yaw = 0.35;      ///< rad, to both sides
};

/// A pose and how well points agree with the map there.
struct ScoredPose {
  Pose T_map_lidar = Pose::Identity();
  double score = 0.0;  ///< 0 to 1; see agreement
};

/// The mean agreement of points with the surfaces of the map, from 0 to 1: a point at distance d
/// from its surface counts 1 / (1 + (d / tolerance)^2), a point without a surface counts 0.
double agreement(LocalMap& map, const Features& points, const Pose& T_map_lidar, double tolerance);

/// Where a scan may be when its motion is unknown: a grid of poses round `T_map_previous`, where
/// the previous scan was `seconds` ago, each with the points de-skewed by the motion that leads
/// there. Returns at most `count` poses that are apart from each other, best first. The grid is as
/// fine as a registration that starts from its best pose needs; `voxel_size` (m) is that of the
/// map.
std::vector<ScoredPose> search_poses(LocalMap& map, const Features& points,
                                     const Pose& T_map_previous, double seconds,
                                     const PoseSearchRange& range, double voxel_size, int count);

}  // namespace lego_loam_sc
