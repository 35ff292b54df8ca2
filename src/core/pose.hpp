// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace lego_loam_sc {

/// A rigid transform. `T_a_b` maps coordinates in frame b to coordinates in frame a.
/// Every frame has x forward, y left, z up (REP-103), in metres.
using Pose = Eigen::Isometry3d;

/// Translation (m) first, then rotation vector (rad).
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Skew-symmetric matrix of the cross product: skew(a) * b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Exponential and logarithm of SO(3): rotation vector (rad) to rotation and back, with an angle in
/// [0, pi].
Eigen::Matrix3d exp_so3(const Eigen::Vector3d& rotation);
Eigen::Vector3d log_so3(const Eigen::Matrix3d& rotation);

/// Exponential and logarithm of SE(3): the motion at constant body velocity for one unit of time.
Pose exp_se3(const Vector6& twist);
Vector6 log_se3(const Pose& pose);

/// The angle of a pose's rotation, rad, in [0, pi].
double rotation_angle(const Pose& pose);

/// Applies a left perturbation, as the solvers use it:
/// R <- Exp(delta.tail(3)) R, t <- t + delta.head(3).
Pose perturb(const Pose& pose, const Vector6& delta);

/// The perturbation between two poses: perturb(from, perturbation_between(from, to)) is `to`.
Vector6 perturbation_between(const Pose& from, const Pose& to);

/// The pose with its rotation projected back onto SO(3), against the round-off of many products.
Pose normalized(const Pose& pose);

/// R_z(yaw) R_y(pitch) R_x(roll), rad.
Eigen::Matrix3d rotation_from_rpy(double roll, double pitch, double yaw);
/// roll, pitch, yaw of a rotation, rad; pitch in [-pi/2, pi/2].
Eigen::Vector3d rpy_from_rotation(const Eigen::Matrix3d& rotation);

/// Unit conversion of angles.
/// @{
constexpr double radians(double degrees) {
  return degrees * 3.14159265358979323846 / 180.0;
}
constexpr double degrees(double radians) {
  return radians * 180.0 / 3.14159265358979323846;
}
/// @}

}  // namespace lego_loam_sc
