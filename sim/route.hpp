// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace lego_loam_sc {

/// A plane curve through waypoints with rounded corners, twice differentiable: a cubic B-spline
/// over points set at equal distances along straight legs and arcs.
class Route {
 public:
  struct Point {
    Eigen::Vector2d position;   ///< m
    Eigen::Vector2d direction;  ///< of length 1
    double curvature;           ///< 1/m, positive to the left
  };

  /// `waypoints`: at least two (m), neighbours apart. A corner's arc has the radius
  /// `corner_radius` (m), or a smaller one that needs no more than half of each leg.
  Route(const std::vector<Eigen::Vector2d>& waypoints, double corner_radius);

  /// m; arc length up to one part in a thousand.
  double length() const { return spacing_ * static_cast<double>(controls_.size() - 1); }

  /// The point at `distance` (m) from the start, which must lie within 0 and length(). The first
  /// and the last waypoint are met exactly.
  Point at(double distance) const;

 private:
  Eigen::Vector2d control(std::ptrdiff_t i) const;

  double spacing_;
  std::vector<Eigen::Vector2d> controls_;
};

}  // namespace lego_loam_sc
