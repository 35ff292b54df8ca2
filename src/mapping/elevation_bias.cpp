// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/elevation_bias.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace lego_loam_sc {
namespace {

// Information of the prior (zero bias), 1/rad^2. Scans share the map and its errors, so their
// information is far from independent.
const double kPriorInformation = 5.0 / std::pow(radians(0.015), 2);
// Share of the accumulated information that damps further corrections. It is small, since the map
// and the past poses bend with the error and hide most of it: each correction is only partial.
constexpr double kDamping = 0.05;
// A larger error means a wrong elevation table, not a worn sensor.
const double kMaxBias = radians(1.0);

}  // namespace

void ElevationBias::add(std::span<const Correspondence> correspondences, const Pose& T_map_lidar,
                        double scale, const NormalEquations<12>& solution) {
  // The bias is one more unknown besides pose and velocity, which are eliminated (Schur
  // complement).
  const Eigen::Vector3d up = T_map_lidar.linear().col(2);
  Eigen::Matrix<double, 12, 1> mixed = Eigen::Matrix<double, 12, 1>::Zero();
  double information = 0.0;
  double gradient = 0.0;
  for (const Correspondence& c : correspondences) {
    if (c.kind != Correspondence::Kind::plane) continue;
    const Eigen::Vector3d rotated = T_map_lidar.linear() * c.point;
    const double d = c.direction.dot(rotated + T_map_lidar.translation() - c.anchor);
    const double derivative = c.direction.dot(up) * c.range_difference;
    Vector6 row;
    row << c.direction, rotated.cross(c.direction);
    const double weight = robust_weight(c, d, scale);
    mixed.head<6>() += weight * derivative * row;
    mixed.tail<6>() += weight * derivative * c.time * row;
    information += weight * derivative * derivative;
    gradient += weight * derivative * d;
  }
  const Eigen::Matrix<double, 12, 1> eliminated = solution.H.ldlt().solve(mixed);
  information -= mixed.dot(eliminated);
  gradient -= solution.g.dot(eliminated);
  if (!(information > 0.0)) return;
  information_ += information;
  value_ -= gradient / (kPriorInformation + kDamping * information_);
  value_ = std::clamp(value_, -kMaxBias, kMaxBias);
}

}  // namespace lego_loam_sc
