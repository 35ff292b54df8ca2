// SPDX-License-Identifier: BSD-3-Clause
#include "core/pose.hpp"

#include <algorithm>
#include <cmath>

namespace lego_loam_sc {
namespace {

// V of exp_se3: translation = V * rho (Barfoot, State Estimation for Robotics, eq. 7.37).
Eigen::Matrix3d left_jacobian_so3(const Eigen::Vector3d& rotation) {
  const double angle = rotation.norm();
  const Eigen::Matrix3d w = skew(rotation);
  if (angle < 1e-5) return Eigen::Matrix3d::Identity() + 0.5 * w + w * w / 6.0;
  const double squared = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / squared * w +
         (angle - std::sin(angle)) / (squared * angle) * w * w;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

Eigen::Matrix3d exp_so3(const Eigen::Vector3d& rotation) {
  const double angle = rotation.norm();
  const Eigen::Matrix3d w = skew(rotation);
  if (angle < 1e-5) return Eigen::Matrix3d::Identity() + w + 0.5 * w * w;
  return Eigen::Matrix3d::Identity() + std::sin(angle) / angle * w +
         (1.0 - std::cos(angle)) / (angle * angle) * w * w;
}

Eigen::Vector3d log_so3(const Eigen::Matrix3d& rotation) {
  // The quaternion is accurate near 0 and pi, where the trace is not.
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < 1e-9) return 2.0 * q.vec();
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

Pose exp_se3(const Vector6& twist) {
  Pose pose = Pose::Identity();
  pose.linear() = exp_so3(twist.tail<3>());
  pose.translation() = left_jacobian_so3(twist.tail<3>()) * twist.head<3>();
  return pose;
}

Vector6 log_se3(const Pose& pose) {
  Vector6 twist;
  twist.tail<3>() = log_so3(pose.linear());
  twist.head<3>() = left_jacobian_so3(twist.tail<3>()).partialPivLu().solve(pose.translation());
  return twist;
}

double rotation_angle(const Pose& pose) {
  return log_so3(pose.linear()).norm();
}

Pose perturb(const Pose& pose, const Vector6& delta) {
  Pose result = Pose::Identity();
  result.linear() = exp_so3(delta.tail<3>()) * pose.linear();
  result.translation() = pose.translation() + delta.head<3>();
  return result;
}

Vector6 perturbation_between(const Pose& from, const Pose& to) {
  Vector6 delta;
  delta << to.translation() - from.translation(), log_so3(to.linear() * from.linear().transpose());
  return delta;
}

Pose normalized(const Pose& pose) {
  Pose result = pose;
  result.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return result;
}

Eigen::Matrix3d rotation_from_rpy(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d rpy_from_rotation(const Eigen::Matrix3d& r) {
  const double pitch = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

}  // namespace lego_loam_sc
