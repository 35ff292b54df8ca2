// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/row_bias.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace lego_loam_sc {
namespace {

// Information of the prior (zero bias), 1/rad^2. Scans share the map and its errors, so their
// information is far from independent.
const double kPriorInformation = 5.0 / std::pow(radians(0.015), 2);
// A larger error means a wrong elevation table, not a worn beam.
const double kMaxBias = radians(0.3);

}  // namespace

void RowBias::add(std::span<const Correspondence> correspondences, const Pose& T_map_lidar,
                  double scale) {
  struct Sums {
    double gradient = 0.0;
    double information = 0.0;
  };
  const Eigen::Vector3d up = T_map_lidar.linear().col(2);
  std::vector<Sums> rows(values_.size());
  Sums all;
  for (const Correspondence& c : correspondences) {
    if (c.kind != Correspondence::Kind::plane) continue;
    if (c.row >= rows.size()) rows.resize(c.row + 1u);
    const double d = c.direction.dot(T_map_lidar * c.point - c.anchor);
    const double derivative = c.direction.dot(up) * c.point.head<2>().norm();
    const double weight = robust_weight(c, d, scale);
    for (Sums* sums : {&rows[c.row], &all}) {
      sums->gradient += weight * derivative * d;
      sums->information += weight * derivative * derivative;
    }
  }
  if (!(all.information > 0.0)) return;

  values_.resize(rows.size(), 0.0);
  information_.resize(rows.size(), 0.0);
  const double common = all.gradient / all.information;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    information_[row] += rows[row].information;
    values_[row] -= (rows[row].gradient - common * rows[row].information) /
                    (kPriorInformation + information_[row]);
  }
  const double mean =
      std::inner_product(values_.begin(), values_.end(), information_.begin(), 0.0) /
      std::accumulate(information_.begin(), information_.end(), 0.0);
  for (double& value : values_) value = std::clamp(value - mean, -kMaxBias, kMaxBias);
}

}  // namespace lego_loam_sc
