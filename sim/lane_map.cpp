// SPDX-License-Identifier: BSD-3-Clause
#include "sim/lane_map.hpp"

#include <algorithm>
#include <cmath>

namespace lego_loam_sc {

using Eigen::Vector2d;

LaneMap::LaneMap(std::span<const Polyline> lanes, const Vector2d& low, const Vector2d& high,
                 double cell, double reach)
    : low_(low),
      cell_(cell),
      nx_(static_cast<int>(std::ceil((high.x() - low.x()) / cell)) + 1),
      ny_(static_cast<int>(std::ceil((high.y() - low.y()) / cell)) + 1),
      distance_(static_cast<std::size_t>(nx_) * ny_, static_cast<float>(reach)) {
  for (const Polyline& lane : lanes)
    for (std::size_t i = 1; i < lane.size(); ++i) add_segment(lane[i - 1], lane[i], reach);
}

void LaneMap::add_segment(const Vector2d& from, const Vector2d& to, double reach) {
  const Vector2d near = (from.cwiseMin(to).array() - reach - low_.array()) / cell_;
  const Vector2d far = (from.cwiseMax(to).array() + reach - low_.array()) / cell_;
  const int i0 = std::max(0, static_cast<int>(std::ceil(near.x())));
  const int j0 = std::max(0, static_cast<int>(std::ceil(near.y())));
  const int i1 = std::min(nx_ - 1, static_cast<int>(std::floor(far.x())));
  const int j1 = std::min(ny_ - 1, static_cast<int>(std::floor(far.y())));
  const Vector2d along = to - from;
  const double scale = 1.0 / std::max(along.squaredNorm(), 1e-12);
  for (int i = i0; i <= i1; ++i) {
    for (int j = j0; j <= j1; ++j) {
      const Vector2d p = corner(i, j) - from;
      const double t = std::clamp(p.dot(along) * scale, 0.0, 1.0);
      float& distance = distance_[index(i, j)];
      distance = std::min(distance, static_cast<float>((p - t * along).norm()));
    }
  }
}

double LaneMap::distance(const Vector2d& place) const {
  const Vector2d p = (place - low_) / cell_;
  const double x = std::clamp(p.x(), 0.0, nx_ - 1.0), y = std::clamp(p.y(), 0.0, ny_ - 1.0);
  const int i = std::min(static_cast<int>(x), nx_ - 2), j = std::min(static_cast<int>(y), ny_ - 2);
  const double u = x - i, v = y - j;
  return (1 - u) * ((1 - v) * distance(i, j) + v * distance(i, j + 1)) +
         u * ((1 - v) * distance(i + 1, j) + v * distance(i + 1, j + 1));
}

}  // namespace lego_loam_sc
