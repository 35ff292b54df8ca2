// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace lego_loam_sc {

/// Times are integer nanoseconds; seconds are for formulas and files.
constexpr double seconds(std::int64_t nanoseconds) {
  return 1e-9 * static_cast<double>(nanoseconds);
}

/// Rounded to the nearest.
inline std::int64_t nanoseconds(double seconds) {
  return std::llround(1e9 * seconds);
}

}  // namespace lego_loam_sc
