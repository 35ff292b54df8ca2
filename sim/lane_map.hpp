// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace lego_loam_sc {

/// A curve in the horizontal plane as closely spaced points, m.
using Polyline = std::vector<Eigen::Vector2d>;

/// A distance field on a grid: the distance to the nearest of a set of lanes.
class LaneMap {
 public:
  /// Distances are capped at `reach` (m).
  LaneMap(std::span<const Polyline> lanes, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
          double cell, double reach);

  /// m, bilinear interpolation; clamped at the border of the map.
  double distance(const Eigen::Vector2d& place) const;

  // The corners of the grid.
  int columns() const { return nx_; }
  int rows() const { return ny_; }
  Eigen::Vector2d corner(int i, int j) const { return low_ + cell_ * Eigen::Vector2d(i, j); }
  double distance(int i, int j) const { return distance_[index(i, j)]; }

 private:
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(i) * ny_ + j; }
  void add_segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double reach);

  Eigen::Vector2d low_;
  double cell_;
  int nx_, ny_;
  std::vector<float> distance_;
};

}  // namespace lego_loam_sc
