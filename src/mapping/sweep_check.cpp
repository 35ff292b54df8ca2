// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sweep_check.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace lego_loam_sc {
namespace {

// A scan tells something when its factor is known to this, one sigma; and no more than if it were
// known to that: the map and the motion are never better.
constexpr double kTellingSigma = 0.5;
constexpr double kBestSigma = 0.1;
// Scans from one that is looked at to the next.
constexpr int kEvery = 4;
// Scans that a verdict needs, and how sure it is.
constexpr int kLeastScans = 10;
constexpr double kSigmas = 5.0;
// A smaller factor is wrong.
constexpr double kFits = 0.7;

Eigen::Vector3d velocity_of(const Eigen::Vector3d& point, const Vector6& twist) {
  return twist.head<3>() + twist.tail<3>().cross(point);
}

}  // namespace

// The pose is free as well: what it can explain says nothing of the times.
void SweepCheck::add(std::span<const Correspondence> correspondences, const Pose& T_map_lidar,
                     double scale, const Vector6& mean_twist, const Vector6& twist) {
  if (offered_++ % kEvery != 0) return;
  using Vector7 = Eigen::Matrix<double, 7, 1>;
  Eigen::Matrix<double, 7, 7> H = Eigen::Matrix<double, 7, 7>::Zero();
  Vector7 g = Vector7::Zero();
  const Eigen::Matrix3d& R = T_map_lidar.linear();
  for (const Correspondence& c : correspondences) {
    if (c.kind != Correspondence::Kind::plane) continue;
    const Eigen::Vector3d rotated = R * c.point;
    const double now = c.direction.dot(rotated + T_map_lidar.translation() - c.anchor);
    const double raw = now - c.time * c.direction.dot(R * velocity_of(c.point, twist));
    Vector7 row;
    row << c.direction, rotated.cross(c.direction),
        c.time * c.direction.dot(R * velocity_of(c.point, mean_twist));
    const double weight = robust_weight(c, now, scale);
    H += weight * row * row.transpose();
    g += weight * raw * row;
  }
  H.diagonal().head<6>().array() += 1e-6;
  const Vector6 cross = H.topRightCorner<6, 1>();
  const Vector6 explained = H.topLeftCorner<6, 6>().ldlt().solve(cross);
  const double information = H(6, 6) - cross.dot(explained);
  if (!(information > 1.0 / (kTellingSigma * kTellingSigma))) return;
  const double factor = -(g(6) - explained.dot(g.head<6>())) / information;
  const double weight = std::min(information, 1.0 / (kBestSigma * kBestSigma));
  ++scans_;
  weights_ += weight;
  squared_weights_ += weight * weight;
  sum_ += weight * factor;
  squares_ += weight * factor * factor;
}

double SweepCheck::factor() const {
  return weights_ > 0.0 ? sum_ / weights_ : 1.0;
}

double SweepCheck::standard_error() const {
  if (scans_ < 2) return std::numeric_limits<double>::infinity();
  const double variance = std::max(squares_ / weights_ - factor() * factor(), 0.0);
  return std::sqrt(variance * squared_weights_) / weights_;
}

bool SweepCheck::fits() const {
  return scans_ < kLeastScans || factor() > kFits || factor() + kSigmas * standard_error() > 1.0;
}

}  // namespace lego_loam_sc
