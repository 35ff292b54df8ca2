// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {

/// Gentle ground: a bicubic B-spline over a square grid, twice differentiable.
class Terrain {
 public:
  /// The smoothest ground over the rectangle from `low` to `high` (m) with the slopes along `path`
  /// (points, m) and the height of its first point. Where the path revisits a place the heights
  /// agree: the closing error of a loop is distributed over it.
  static Terrain along(std::span<const Eigen::Vector3d> path, const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high);

  /// m. Outside the rectangle the ground is that of its edge.
  double height(const Eigen::Vector2d& place) const;

  /// Derivative of the height along x and y.
  Eigen::Vector2d slope(const Eigen::Vector2d& place) const;

 private:
  Terrain(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

  struct Patch;  // where a place lies between the controls
  Patch patch_at(const Eigen::Vector2d& place) const;

  Eigen::Vector2d low_;
  int nx_, ny_;                   // controls along x and y
  std::vector<double> controls_;  // y fastest
};

/// The pose of an object on the ground at `place`, normal to the slope, with x towards `yaw` (rad).
Pose stand_on(const Terrain& terrain, const Eigen::Vector2d& place, double yaw);

}  // namespace lego_loam_sc
