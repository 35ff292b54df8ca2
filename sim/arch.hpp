// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace lego_loam_sc {

/// The cross-section of a tunnel: a level floor, upright walls and half an ellipse above them, m.
/// Points of the section are (to the left of the middle, above the floor).
struct Arch {
  double half_width;
  double wall;  ///< height of the upright walls
  double rise;  ///< of the ellipse above the walls

  /// The middle of the ellipse, from which all of the section can be seen.
  Eigen::Vector2d centre() const { return {0.0, wall}; }

  /// Distance from the centre to the section at an angle (rad, 0 to the left, pi / 2 upwards).
  double radius(double angle) const;

  /// Where a ray from the centre at an angle meets the section.
  Eigen::Vector2d at(double angle) const;

  /// The angle of the floor's left end; that of its right end is pi less this.
  double floor_angle() const;
};

}  // namespace lego_loam_sc
