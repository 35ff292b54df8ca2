// SPDX-License-Identifier: BSD-3-Clause
#include "sim/arch.hpp"

#include <algorithm>
#include <cmath>

namespace lego_loam_sc {

double Arch::radius(double angle) const {
  const double across = std::abs(std::cos(angle)), up = std::sin(angle);
  if (up >= 0.0) return 1.0 / std::hypot(across / half_width, up / rise);
  return 1.0 / std::max(across / half_width, -up / wall);
}

Eigen::Vector2d Arch::at(double angle) const {
  return centre() + radius(angle) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

double Arch::floor_angle() const {
  return -std::atan2(wall, half_width);
}

}  // namespace lego_loam_sc
