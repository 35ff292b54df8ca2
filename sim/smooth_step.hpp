// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace lego_loam_sc {

/// From 0 at x = 0 to 1 at x = 1, level before and after, with a continuous slope.
inline double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace lego_loam_sc
