// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/voxel_table.hpp"

namespace lego_loam_sc {

/// The first point of each voxel, in the order of the points. `position(point)` gives its
/// coordinates; `size` in their unit, 0 keeps all.
template <class Point, class Position>
std::vector<Point> voxel_filter(const std::vector<Point>& points, double size,
                                Position&& position) {
  if (size <= 0.0) return points;
  struct Nothing {};
  VoxelTable<Nothing> seen;
  seen.reserve(points.size() / 2);
  std::vector<Point> kept;
  for (const Point& point : points) {
    const auto key = key_of(position(point).template cast<double>() / size);
    if (key && seen.find_or_insert(*key).second) kept.push_back(point);
  }
  return kept;
}

}  // namespace lego_loam_sc
