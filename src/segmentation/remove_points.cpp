// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/remove_points.hpp"

#include <cstddef>

namespace lego_loam_sc {
namespace {

template <class T>
void keep_others(const std::vector<std::uint8_t>& remove, std::vector<T>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!remove[i]) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace

void remove_points(const std::vector<std::uint8_t>& remove, RangeImage& image) {
  std::uint32_t kept = 0;
  for (int row = 0; row < image.rows; ++row) {
    const std::uint32_t begin = image.row_begin[row];
    const std::uint32_t end = image.row_begin[row + 1];
    image.row_begin[row] = kept;
    for (std::uint32_t i = begin; i < end; ++i) kept += remove[i] == 0;
  }
  image.row_begin[image.rows] = kept;
  keep_others(remove, image.points);
  keep_others(remove, image.range);
  keep_others(remove, image.intensity);
  keep_others(remove, image.time);
  keep_others(remove, image.column);
  fill_pixels(image);
}

}  // namespace lego_loam_sc
