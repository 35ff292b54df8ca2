// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sweep_priors.hpp"

#include <algorithm>

namespace lego_loam_sc {
namespace {

// Sigma of fixed directions, m or rad, and smallest sigma of the velocity, m/s or rad/s.
constexpr double kMinSigma = 1e-3;

}  // namespace

PosePrior::PosePrior(const Pose& guess, double sigma_translation, double sigma_rotation)
    : guess_(guess) {
  const double t = 1.0 / (sigma_translation * sigma_translation);
  const double r = 1.0 / (sigma_rotation * sigma_rotation);
  information_.diagonal() << t, t, t, r, r, r;
}

void PosePrior::fix_degenerate(const Localizability& localizability) {
  constexpr double kInformation = 1.0 / (kMinSigma * kMinSigma);
  information_ += degenerate_projection(localizability, kInformation, kInformation);
}

void PosePrior::add_to(NormalEquations<12>& equations, const Pose& at) const {
  const Vector6 deviation = perturbation_between(guess_, at);
  equations.H.topLeftCorner<6, 6>() += information_;
  equations.g.head<6>() += information_ * deviation;
  equations.cost += 0.5 * deviation.dot(information_ * deviation);
}

VelocityPrior::VelocityPrior(const Pose& T_previous_map, double seconds, double acceleration,
                             double angular_acceleration)
    : T_previous_map_(T_previous_map), seconds_(seconds) {
  // The mean velocity of the motion is that at half a period ago.
  const double t = std::max(0.5 * seconds * acceleration, kMinSigma);
  const double r = std::max(0.5 * seconds * angular_acceleration, kMinSigma);
  information_ << Eigen::Vector3d::Constant(1.0 / (t * t)),
      Eigen::Vector3d::Constant(1.0 / (r * r));
}

Vector6 VelocityPrior::mean(const Pose& T_map_lidar) const {
  return log_se3(T_previous_map_ * T_map_lidar) / seconds_;
}

void VelocityPrior::add_to(NormalEquations<12>& equations, const Sweep& at,
                           const Vector6& twist) const {
  const Eigen::Matrix3d to_lidar = at.T_map_lidar.linear().transpose();
  Eigen::Matrix<double, 6, 12> J = Eigen::Matrix<double, 6, 12>::Zero();
  J.block<3, 3>(0, 6) = J.block<3, 3>(3, 9) = to_lidar;
  J.leftCols<6>() = J.rightCols<6>() * (-1.0 / seconds_);
  const Vector6 e = twist + J.rightCols<6>() * at.velocity_change - mean(at.T_map_lidar);
  equations.H += J.transpose() * information_.asDiagonal() * J;
  equations.g += J.transpose() * (information_.cwiseProduct(e));
  equations.cost += 0.5 * e.dot(information_.cwiseProduct(e));
}

}  // namespace lego_loam_sc
