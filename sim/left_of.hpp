// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace lego_loam_sc {

/// A direction on the plan turned by a quarter to the left.
inline Eigen::Vector2d left_of(const Eigen::Vector2d& direction) {
  return {-direction.y(), direction.x()};
}

}  // namespace lego_loam_sc
