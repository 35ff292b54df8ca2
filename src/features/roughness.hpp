// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace lego_loam_sc {

/// Roughness of a point without enough neighbours on both sides.
constexpr float kNoRoughness = std::numeric_limits<float>::quiet_NaN();

/// Equation (1) for the points of one row, which is a closed ring:
///   c_i = |sum_{j in S, j != i} (r_j - r_i)| / (|S| |r_i|),
/// S being the `neighbours` points on each side of i. `range` in m. A non-zero `gap_before`
/// separates a point from the previous one; points with a gap in S get kNoRoughness.
std::vector<float> roughness(const std::vector<float>& range,
                             const std::vector<std::uint8_t>& gap_before, int neighbours);

}  // namespace lego_loam_sc
