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
  std::vector<float> r(count + 2 * neighbours);
  for (int i = 0; i < count; ++i) r[i + neighbours] = range[i];
  for (int i = 0; i < neighbours; ++i) {
    r[i] = range[count - neighbours + i];
    r[count + neighbours + i] = range[i];
  }

  // gaps[i] = number of wide steps before point i of the closed row; equal at both ends of a
  // window when the window has none.
  std::vector<int> gaps(r.size(), 0);
  for (std::size_t i = 1; i < r.size(); ++i) {
    const int here = (static_cast<int>(i) - neighbours + count) % count;
    const int before = (here - 1 + count) % count;
    const int step = column[here] - column[before] + (here == 0 ? columns : 0);
    gaps[i] = gaps[i - 1] + (step > max_column_gap ? 1 : 0);
  }

  for (int i = 0; i < count; ++i) {
    if (gaps[i] != gaps[i + 2 * neighbours]) continue;
    float sum = 0.0f;
    for (int k = 0; k <= 2 * neighbours; ++k) sum += r[i + k];
    sum -= static_cast<float>(2 * neighbours + 1) * range[i];
    result[i] = std::abs(sum) / (2.0f * static_cast<float>(neighbours) * range[i]);
  }
  return result;
}

}  // namespace lego_loam_sc
