// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "core/pose.hpp"
#include "features/features.hpp"
#include "map/local_map.hpp"

namespace lego_loam_sc {

/// How well a scan fixes its pose in one direction.
struct Observability {
  /// Sigmas. How significantly the scan fits the map better at the pose than beside it.
  double significance = 0.0;
  /// Standard error of the pose in the direction, in steps; infinite when the fit is not better.
  double standard_error = std::numeric_limits<double>::infinity();
};

/// Compares the costs of all points at a pose with those at the pose perturbed by +`step` and
/// -`step`. The significance is their mean rise over its own standard error; the standard error of
/// the pose that of the gradient over the curvature, as for any M-estimator. Correspondences are
/// searched anew at each pose, so that neither the noise of points and normals nor the grid of the
/// map pretends a constraint: where the scan does not constrain the direction, as along a tunnel,
/// the expected significance is 0. `range_noise` in m, one sigma.
Observability observability(LocalMap& map, const Features& points, const Pose& T_map_lidar,
                            const Vector6& step, double range_noise);

}  // namespace lego_loam_sc
