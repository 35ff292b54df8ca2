// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace lego_loam_sc {

/// A way on the plan as closely set points, m.
using Polyline = std::vector<Eigen::Vector2d>;

/// How far every place of the plan is from the nearest of a set of ways, on a grid.
class LaneMap {
 public:
  /// Distances count up to `reach` (m); farther places have `reach`.
  LaneMap(std::span<const Polyline> lanes, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
          double cell, double reach);

  /// m, linear between the corners of the grid; at the edge of the map as within.
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
