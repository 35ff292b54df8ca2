// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pose.hpp"
#include "registration/levenberg_marquardt.hpp"
#include "registration/localizability.hpp"

namespace lego_loam_sc {

/// A sweep that is being matched: its pose, and the change of its velocity since it was de-skewed
/// (m/s and rad/s), both in the map's axes at the reference time.
struct Sweep {
  Pose T_map_lidar;
  Vector6 velocity_change = Vector6::Zero();
};

/// What is known of the pose beforehand: deviations from the guess cost (delta / sigma)^2 / 2.
class PosePrior {
 public:
  /// Sigmas in m and rad.
  PosePrior(const Pose& guess, double sigma_translation, double sigma_rotation);

  /// Ties the directions that are degenerate to the guess.
  void tie(const Localizability& localizability);

  void add_to(NormalEquations<12>& equations, const Pose& at) const;

 private:
  Pose guess_;
  Matrix6 information_ = Matrix6::Zero();
};

/// What is known of the velocity beforehand: it is that of the motion since the previous scan, but
/// for an acceleration.
class VelocityPrior {
 public:
  /// `seconds` since the previous scan; the accelerations, one sigma, in m/s^2 and rad/s^2.
  VelocityPrior(const Pose& T_previous_map, double seconds, double acceleration,
                double angular_acceleration);

  /// The velocity if the sweep has this pose, m/s and rad/s in the sensor's own frame.
  Vector6 mean(const Pose& T_map_lidar) const;

  /// `twist`: that the sweep was de-skewed with.
  void add_to(NormalEquations<12>& equations, const Sweep& at, const Vector6& twist) const;

 private:
  Pose T_previous_map_;
  double seconds_;
  Vector6 information_;
};

}  // namespace lego_loam_sc
