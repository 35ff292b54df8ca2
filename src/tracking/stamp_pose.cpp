// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stamp_pose.hpp"

namespace lego_loam_sc {

Pose extrapolate(const Vector6& twist, double age) {
  return exp_se3(twist * age);
}

Pose interpolate(const Pose& T_previous_current, const Vector6& twist_previous,
                 const Vector6& twist, double seconds, double age) {
  if (age >= 0.0 || age <= -seconds) return extrapolate(twist, age);
  // In coordinates of the tangent at the current pose, which is their origin. Between two scans the
  // rotation is small enough for the velocities to share them.
  const Vector6 from = log_se3(T_previous_current.inverse());
  const double u = 1.0 + age / seconds;
  const double w = 1.0 - u;
  return exp_se3((1.0 + 2.0 * u) * w * w * from + u * w * w * seconds * twist_previous -
                 u * u * w * seconds * twist);
}

}  // namespace lego_loam_sc
