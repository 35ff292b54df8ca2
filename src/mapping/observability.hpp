// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pose.hpp"
#include "features/features.hpp"
#include "map/local_map.hpp"

namespace lego_loam_sc {

/// How significantly the scan fits the map better at a pose than a little beside it, in sigmas: the
/// mean over all points of the rise of their costs when the pose is perturbed by +`step` and
/// -`step`, divided by its standard error. Correspondences are searched anew at each pose, so that
/// neither the noise of points and normals nor the grid of the map pretends a constraint: where the
/// scan does not constrain the direction, as along a tunnel, the expected value is 0. `range_noise`
/// in m, one sigma.
double significance(LocalMap& map, const Features& points, const Pose& T_map_lidar,
                    const Vector6& step, double range_noise);

}  // namespace lego_loam_sc
