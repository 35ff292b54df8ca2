// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>

namespace lego_loam_sc {

/// Height of the ground (m) at a position in the world (m). Its slope is continuous.
using Ground = std::function<double(double x, double y)>;

/// A direction in the horizontal plane, turned left by 90 degrees.
inline Eigen::Vector2d left_of(const Eigen::Vector2d& direction) {
  return {-direction.y(), direction.x()};
}

/// Smooth step from 0 at x = 0 to 1 at x = 1, constant outside, with a continuous slope.
inline double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace lego_loam_sc
