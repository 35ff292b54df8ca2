// SPDX-License-Identifier: BSD-3-Clause
#include "sim/noise.hpp"

#include <array>
#include <cmath>

#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

// From 0 to 1 with two derivatives that vanish at both ends.
double fade(double t) {
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

}  // namespace

// Random values at the whole numbers, blended in between.
double smooth_noise(const Eigen::Vector3d& place, std::uint64_t seed) {
  const Eigen::Vector3d cell = place.array().floor();
  std::array<std::array<double, 2>, 3> weight;
  for (int axis = 0; axis < 3; ++axis) {
    const double high = fade(place[axis] - cell[axis]);
    weight[axis] = {1.0 - high, high};
  }
  const auto index = [&](int axis, int step) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[axis]) + step);
  };
  double sum = 0.0;
  for (int i = 0; i < 2; ++i) {
    const std::uint64_t x_key = hash(seed, index(0, i));
    for (int j = 0; j < 2; ++j) {
      const std::uint64_t y_key = hash(x_key, index(1, j));
      for (int k = 0; k < 2; ++k) {
        const double value = 2.0 * Random(hash(y_key, index(2, k))).uniform() - 1.0;
        sum += weight[0][i] * weight[1][j] * weight[2][k] * value;
      }
    }
  }
  return sum;
}

}  // namespace lego_loam_sc
