// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/isolated_returns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/pose.hpp"

namespace lego_loam_sc {
namespace {

// Neighbours of one surface differ in range by the way from beam to beam times this at most, and by
// noise, in sigmas. Rows are far apart: a surface that is slanted more shows itself along the row.
constexpr float kSlantAlongRow = 10.0F;
constexpr float kSlantAcrossRows = 3.0F;
constexpr float kNoise = 4.0F;
// Columns that are looked at to either side.
constexpr int kColumns = 2;
// A neighbour is behind a return when it is this much farther: no edge of a wall is in the air.
constexpr float kBehind = 1.2F;

}  // namespace

std::size_t mark_isolated_returns(const RangeImage& image, const SensorModel& sensor,
                                  std::vector<std::uint8_t>& remove) {
  const auto noise = kNoise * static_cast<float>(sensor.range_noise);
  const float along_row =
      kSlantAlongRow * 2.0F * std::numbers::pi_v<float> / static_cast<float>(image.columns);
  std::vector<float> to_upper(image.rows, 0.0F);
  for (int row = 0; row + 1 < image.rows; ++row)
    to_upper[row] =
        kSlantAcrossRows *
        static_cast<float>(radians(sensor.elevation_deg[row + 1] - sensor.elevation_deg[row]));

  std::size_t count = 0;
  for (int row = 0; row < image.rows; ++row) {
    for (std::uint32_t i = image.row_begin[row]; i < image.row_begin[row + 1]; ++i) {
      const float range = image.range[i];
      int behind = 0;
      const auto is_near = [&](int neighbour_row, int column, float slope) {
        if (neighbour_row < 0 || neighbour_row >= image.rows) return false;
        const std::int32_t k =
            image.pixel(neighbour_row, (column + image.columns) % image.columns);
        if (k < 0 || k == static_cast<std::int32_t>(i)) return false;
        behind += image.range[k] > kBehind * range;
        return std::abs(image.range[k] - range) <= noise + slope * range;
      };
      const int column = image.column[i];
      bool near = false;
      for (int d = 1; d <= kColumns && !near; ++d) {
        const int step = d * image.usual_step;
        near = is_near(row, column - step, along_row * static_cast<float>(step)) ||
               is_near(row, column + step, along_row * static_cast<float>(step));
      }
      if (near) continue;
      near = is_near(row + 1, column, to_upper[row]) ||
             (row > 0 && is_near(row - 1, column, to_upper[row - 1]));
      if (near || behind < 2) continue;
      remove[i] = 1;
      ++count;
    }
  }
  return count;
}

}  // namespace lego_loam_sc
