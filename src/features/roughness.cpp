// SPDX-License-Identifier: BSD-3-Clause
#include "features/roughness.hpp"

#include <cmath>
#include <cstddef>

namespace lego_loam_sc {

std::vector<float> roughness(const std::vector<float>& range,
                             const std::vector<std::uint16_t>& column, int columns, int neighbours,
                             int max_column_gap) {
  const int count = static_cast<int>(range.size());
  std::vector<float> result(count, kNoRoughness);
  if (count <= 2 * neighbours) return result;

  // The row closed to a ring: `neighbours` points of the other end on each side.
  const int wings = 2 * neighbours;
  std::vector<float> r(count + wings);
  std::vector<int> unrolled(count + wings);  // columns, ascending across the seam
  for (int i = 0; i < count; ++i) {
    r[i + neighbours] = range[i];
    unrolled[i + neighbours] = column[i];
  }
  for (int i = 0; i < neighbours; ++i) {
    r[i] = range[count - neighbours + i];
    r[count + neighbours + i] = range[i];
    unrolled[i] = column[count - neighbours + i] - columns;
    unrolled[count + neighbours + i] = column[i] + columns;
  }

  // gaps[i] = number of wide steps before point i of the closed row; equal at both ends of a
  // window when the window has none.
  std::vector<int> gaps(count + wings, 0);
  for (int i = 1; i < count + wings; ++i)
    gaps[i] = gaps[i - 1] + (unrolled[i] - unrolled[i - 1] > max_column_gap ? 1 : 0);

  // Neighbour by neighbour for the whole row, which the compiler vectorises.
  std::vector<float> sum(count, 0.0f);
  for (int k = 0; k <= wings; ++k)
    for (int i = 0; i < count; ++i) sum[i] += r[i + k];
  for (int i = 0; i < count; ++i) {
    const float difference = sum[i] - static_cast<float>(wings + 1) * range[i];
    const float c = std::abs(difference) / (2.0f * static_cast<float>(neighbours) * range[i]);
    result[i] = gaps[i] == gaps[i + wings] ? c : kNoRoughness;
  }
  return result;
}

}  // namespace lego_loam_sc
