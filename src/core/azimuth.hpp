// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

namespace lego_loam_sc {

/// atan2 in (-pi, pi] with an error of at most 1e-5 rad, a hundredth of a column of the finest
/// range image. Odd minimax polynomial of atan on [0, 1], degree 11.
inline float fast_atan2(float y, float x) {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const float larger = ax > ay ? ax : ay;
  const float smaller = ax > ay ? ay : ax;
  const float a = smaller / (larger == 0.0f ? 1.0f : larger);
  const float s = a * a;
  float r =
      a * (0.99997726f +
           s * (-0.33262347f +
                s * (0.19354346f + s * (-0.11643287f + s * (0.05265332f + s * -0.01172120f)))));
  // Conditional expressions instead of branches let the compiler vectorise loops.
  r = ay > ax ? 0.5f * std::numbers::pi_v<float> - r : r;
  r = x < 0.0f ? std::numbers::pi_v<float> - r : r;
  return y < 0.0f ? -r : r;
}

}  // namespace lego_loam_sc
