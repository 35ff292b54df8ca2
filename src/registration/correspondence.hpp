// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "registration/levenberg_marquardt.hpp"

namespace lego_loam_sc {

/// A point of the source cloud and the plane, line or point of the target that it should lie on.
struct Correspondence {
  /// What the point should lie on.
  enum class Kind { plane, line, point };

  Kind kind = Kind::plane;
  Eigen::Vector3d point;   ///< in the source frame, m
  Eigen::Vector3d anchor;  ///< a point of the plane or line, or the point; target frame, m
  /// Unit normal of the plane, unit direction of the line, 0 for a point.
  Eigen::Vector3d direction;
  double weight = 1.0;            ///< 1 / variance of the distance, 1/m^2
  double range_difference = 0.0;  ///< m; horizontal range of the point minus that of the plane
  double time = 0.0;              ///< s, of the measurement after the reference time of its scan
  std::uint16_t row = 0;          ///< of the sensor that measured the point
};

/// Distance of the transformed point from its plane, line or point, m, >= 0.
double distance(const Correspondence& c, const Pose& T_target_source);

/// How the scale of Cauchy's kernel follows from the residuals: `factor` times their robust sigma,
/// within [min_scale, max_scale]. All in sigmas of the correspondences.
struct RobustKernel {
  double factor = 2.0;
  double min_scale = 1.0;
  double max_scale = 20.0;
};

/// The scale of the kernel for these correspondences; `max_scale` when there are none.
double robust_scale(std::span<const Correspondence> correspondences, const Pose& T_target_source,
                    const RobustKernel& kernel);

/// The weight of a distance (m) with Cauchy's kernel, 1/m^2. Distances beyond `scale` sigmas of the
/// correspondence lose their influence, so rough surfaces tolerate larger distances than smooth
/// ones.
double robust_weight(const Correspondence& c, double distance, double scale);

/// Robust sigma of the distances (from their median), m; 0 when there are none.
double robust_sigma(std::span<const Correspondence> correspondences, const Pose& T_target_source);

/// Normal equations of all correspondences for the perturbation of core/pose.hpp, translation
/// first: d(distance)/dt = n', d(distance)/dtheta = ((R p) x n)'.
NormalEquations<6> normal_equations(std::span<const Correspondence> correspondences,
                                    const Pose& T_target_source, double scale);

/// The same for a sweep whose velocity is unknown too. The last six unknowns are the correction of
/// the velocity that the points were de-skewed with, m/s and rad/s in the target frame at the
/// reference time; `velocity_change` is its present value. The Jacobian of a point measured at time
/// t with respect to them is t times that with respect to the pose.
NormalEquations<12> sweep_normal_equations(std::span<const Correspondence> correspondences,
                                           const Pose& T_target_source,
                                           const Vector6& velocity_change, double scale);

/// The normal equations of a subset of the six unknowns.
template <std::size_t N>
NormalEquations<N> restrict_to(const NormalEquations<6>& all, const std::array<int, N>& unknowns) {
  NormalEquations<N> some;
  some.H = all.H(unknowns, unknowns);
  some.g = all.g(unknowns);
  some.cost = all.cost;
  return some;
}

}  // namespace lego_loam_sc
