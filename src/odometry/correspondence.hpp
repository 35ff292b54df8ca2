// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "odometry/levenberg_marquardt.hpp"

namespace lego_loam_sc {

/// A point of the current scan and the plane or line of the target that it should lie on.
struct Correspondence {
  enum class Kind { plane, line };

  Kind kind = Kind::plane;
  Eigen::Vector3d point;      ///< in the source frame, m
  Eigen::Vector3d anchor;     ///< on the plane or line, in the target frame, m
  Eigen::Vector3d direction;  ///< unit normal of the plane, or unit direction of the line
  double weight = 1.0;        ///< 1 / variance of the distance, 1/m^2
  double range_difference = 0.0;  ///< m; horizontal range of the point less that of the plane
};

/// Distance of the transformed point from its plane or line, m, >= 0.
double distance(const Correspondence& c, const Pose& T_target_source);

/// Cauchy's kernel: residuals beyond `scale` (m) lose their influence.
double robust_weight(double distance, double scale);

/// A scale for the kernel from the data: `factor` robust sigmas (median of the distances), within
/// [minimum, maximum] metres.
double robust_scale(std::span<const Correspondence> correspondences, const Pose& T_target_source,
                    double factor, double minimum, double maximum);

/// Normal equations of all correspondences for the perturbation of core/pose.hpp, translation
/// first: d(distance)/dt = n', d(distance)/dtheta = ((R p) x n)'.
NormalEquations<6> normal_equations(std::span<const Correspondence> correspondences,
                                    const Pose& T_target_source, double scale);

/// The rows and columns of some of the six unknowns.
template <std::size_t N>
NormalEquations<N> restrict_to(const NormalEquations<6>& all, const std::array<int, N>& unknowns) {
  NormalEquations<N> some;
  some.cost = all.cost;
  for (std::size_t i = 0; i < N; ++i) {
    some.g[i] = all.g[unknowns[i]];
    for (std::size_t j = 0; j < N; ++j) some.H(i, j) = all.H(unknowns[i], unknowns[j]);
  }
  return some;
}

}  // namespace lego_loam_sc
