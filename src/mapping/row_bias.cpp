// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/row_bias.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lego_loam_sc {
namespace {

// 1/rad^2, that a correction needs at first: scans share the map and its errors, so one by one they
// say little.
const double kFirstInformation = 5.0 / std::pow(radians(0.015), 2);
// A larger error is no worn beam but a wrong table.
const double kLargest = radians(0.3);

}  // namespace

void RowBias::add(std::span<const Correspondence> correspondences, const Pose& T_map_lidar,
                  double scale) {
  const Eigen::Vector3d up = T_map_lidar.linear().col(2);
  std::vector<double> gradient;
  for (const Correspondence& c : correspondences) {
    if (c.kind != Correspondence::Kind::plane) continue;
    if (c.row >= gradient.size()) gradient.resize(c.row + 1u, 0.0);
    if (c.row >= values_.size()) {
      values_.resize(c.row + 1u, 0.0);
      information_.resize(c.row + 1u, 0.0);
    }
    const double d = c.direction.dot(T_map_lidar * c.point - c.anchor);
    const double derivative = c.direction.dot(up) * c.point.head<2>().norm();
    const double weight = robust_weight(c, d, scale);
    gradient[c.row] += weight * derivative * d;
    information_[c.row] += weight * derivative * derivative;
  }
  for (std::size_t row = 0; row < gradient.size(); ++row)
    values_[row] -= gradient[row] / (kFirstInformation + information_[row]);

  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t row = 0; row < values_.size(); ++row) {
    sum += information_[row] * values_[row];
    weights += information_[row];
  }
  if (!(weights > 0.0)) return;
  for (double& value : values_) value = std::clamp(value - sum / weights, -kLargest, kLargest);
}

}  // namespace lego_loam_sc
