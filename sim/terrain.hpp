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
  /// The smoothest ground over the rectangle from `low` to `high` (m) that climbs along `way` as
  /// its points (m) climb and has the first one's height there. Where the way comes back to a
  /// place, the heights agree: what the climbs of a loop do not cancel is spread over it.
  static Terrain along(std::span<const Eigen::Vector3d> way, const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high);

  /// m. Outside the rectangle the ground goes on as at its edge.
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

/// A thing on the ground at `place`, upright on its slope, with x towards `yaw` (rad).
Pose stand_on(const Terrain& terrain, const Eigen::Vector2d& place, double yaw);

}  // namespace lego_loam_sc
