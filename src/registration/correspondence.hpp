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

/// A point of the current scan and the plane, line or point of the target that it should lie on.
struct Correspondence {
  enum class Kind { plane, line, point };

  Kind kind = Kind::plane;
  Eigen::Vector3d point;   ///< in the source frame, m
  Eigen::Vector3d anchor;  ///< on the plane or line or the point itself, in the target frame, m
  Eigen::Vector3d
      direction;        ///< unit normal of the plane, or unit direction of the line; 0 of a point
  double weight = 1.0;  ///< 1 / variance of the distance, 1/m^2
  double range_difference = 0.0;  ///< m; horizontal range of the point less that of the plane
  double age = 0.0;               ///< s after the reference time at which the point was seen
  std::uint16_t row = 0;          ///< of the sensor that saw the point
};

/// Distance of the transformed point from its plane, line or point, m, >= 0.
double distance(const Correspondence& c, const Pose& T_target_source);

/// The weight of a distance (m) with Cauchy's kernel, 1/m^2: distances of more than `scale` of the
/// correspondence's own sigmas lose their influence. So what is rough is allowed more than what is
/// smooth.
double robust_weight(const Correspondence& c, double distance, double scale);

/// A scale for the kernel from the data: `factor` times the robust spread (median) of the distances
/// in sigmas, within [minimum, maximum].
double robust_scale(std::span<const Correspondence> correspondences, const Pose& T_target_source,
                    double factor, double minimum, double maximum);

/// Robust sigma (median) of the distances, m; 0 of none.
double spread(std::span<const Correspondence> correspondences, const Pose& T_target_source);

/// Normal equations of all correspondences for the perturbation of core/pose.hpp, translation
/// first: d(distance)/dt = n', d(distance)/dtheta = ((R p) x n)'.
NormalEquations<6> normal_equations(std::span<const Correspondence> correspondences,
                                    const Pose& T_target_source, double scale);

/// The same for a sweep whose motion is unknown too. The points are de-skewed with a velocity that
/// is off by `velocity_change`: the last six unknowns, m/s and rad/s in the target frame at the
/// reference time. A point of age a moves with them by a times what it moves with the pose.
NormalEquations<12> sweep_normal_equations(std::span<const Correspondence> correspondences,
                                           const Pose& T_target_source,
                                           const Vector6& velocity_change, double scale);

/// The rows and columns of some of the six unknowns.
template <std::size_t N>
NormalEquations<N> restrict_to(const NormalEquations<6>& all, const std::array<int, N>& unknowns) {
  NormalEquations<N> some;
  some.H = all.H(unknowns, unknowns);
  some.g = all.g(unknowns);
  some.cost = all.cost;
  return some;
}

}  // namespace lego_loam_sc
