// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pose.hpp"
#include "registration/levenberg_marquardt.hpp"
#include "registration/localizability.hpp"

namespace lego_loam_sc {

/// The state of a sweep in the solver: its pose and the correction of the velocity that it was
/// de-skewed with (m/s and rad/s), both in map axes at the reference time.
struct Sweep {
  Pose T_map_lidar;
  Vector6 velocity_change = Vector6::Zero();
};

/// Gaussian prior of the pose: a deviation from the guess costs (delta / sigma)^2 / 2.
class PosePrior {
 public:
  /// Sigmas in m and rad.
  PosePrior(const Pose& guess, double sigma_translation, double sigma_rotation);

  /// Fixes the degenerate directions to the guess.
  void fix_degenerate(const Localizability& localizability);

  /// Adds the cost of a deviation at this pose and its derivatives.
  void add_to(NormalEquations<12>& equations, const Pose& at) const;

 private:
  Pose guess_;
  Matrix6 information_ = Matrix6::Zero();
};

/// Gaussian prior of the velocity: the mean velocity since the previous scan, uncertain by the
/// acceleration.
class VelocityPrior {
 public:
  /// `seconds` since the previous scan; accelerations as one sigma, m/s^2 and rad/s^2.
  VelocityPrior(const Pose& T_previous_map, double seconds, double acceleration,
                double angular_acceleration);

  /// The mean for this pose of the sweep, m/s and rad/s in the LiDAR frame.
  Vector6 mean(const Pose& T_map_lidar) const;

  /// `twist`: the velocity that the sweep was de-skewed with.
  void add_to(NormalEquations<12>& equations, const Sweep& at, const Vector6& twist) const;

 private:
  Pose T_previous_map_;
  double seconds_;
  Vector6 information_;
};

}  // namespace lego_loam_sc
