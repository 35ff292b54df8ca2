// SPDX-License-Identifier: BSD-3-Clause
#include "features/roughness.hpp"

#include <cmath>
#include <cstddef>

namespace lego_loam_sc {

std::vector<float> roughness(const std::vector<float>& range,
                             const std::vector<std::uint8_t>& gap_before, int neighbours) {
  const int count = static_cast<int>(range.size());
  std::vector<float> result(count, kNoRoughness);
  if (count <= 2 * neighbours) return result;

  // The row extended on each side by `neighbours` points of its other end.
  const int window = 2 * neighbours;
  std::vector<float> r(count + window);
  // Number of gaps before each point of the extended row; equal at both ends of a window without
  // gaps.
  std::vector<int> gaps(count + window, 0);
  for (int i = 0; i < count + window; ++i) {
    int point = i - neighbours;
    if (point < 0) point += count;
    if (point >= count) point -= count;
    r[i] = range[point];
    if (i > 0) gaps[i] = gaps[i - 1] + (gap_before[point] != 0 ? 1 : 0);
  }

  // One neighbour at a time for the whole row, so that the compiler vectorises the loop.
  std::vector<float> sum(count, 0.0f);
  for (int k = 0; k <= window; ++k)
    for (int i = 0; i < count; ++i) sum[i] += r[i + k];
  for (int i = 0; i < count; ++i) {
    const float difference = sum[i] - static_cast<float>(window + 1) * range[i];
    const float c = std::abs(difference) / (2.0f * static_cast<float>(neighbours) * range[i]);
    result[i] = gaps[i] == gaps[i + window] ? c : kNoRoughness;
  }
  return result;
}

}  // namespace lego_loam_sc
