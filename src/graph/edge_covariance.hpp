// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pose.hpp"
#include "graph/settings.hpp"
#include "registration/localizability.hpp"

namespace lego_loam_sc {

/// Covariance of the pose graph's edges, in the convention of PoseEdge. `covariance` is that of
/// the scan matcher for the perturbation of core/pose.hpp, `R` the rotation of the matched pose.
/// Floors are added, because the matcher knows the noise of its points but not moving objects,
/// distortion and calibration.
Matrix6 loop_covariance(const Matrix6& covariance, const Eigen::Matrix3d& R,
                        const GraphSettings& settings);

/// The same for the edge from the last key frame; the sigma of degenerate directions is inflated.
Matrix6 odometry_covariance(const Matrix6& covariance, const Eigen::Matrix3d& R,
                            const Localizability& localizability, const GraphSettings& settings);

}  // namespace lego_loam_sc
