// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/features.hpp"
#include "map/voxel_table.hpp"

namespace lego_loam_sc {

/// Keeps one point of each voxel, in the order of the points. A fixed pseudo-random sequence
/// decides which: the first point of a voxel is biased by its noise, and walls along the scan
/// direction would appear rotated. `position(point)` returns the coordinates of a point; `size` in
/// their unit, 0 keeps all points; points that are not finite are dropped.
template <class Point, class Position>
std::vector<Point> voxel_filter(const std::vector<Point>& points, double size,
                                Position&& position) {
  if (size <= 0.0) return points;
  constexpr std::uint32_t kNone = ~0u;
  struct Voxel {
    std::uint32_t number = 0;
  };
  VoxelTable<Voxel> voxels;
  voxels.reserve(points.size() / 2);
  std::vector<std::uint32_t> voxel_of, left;
  voxel_of.reserve(points.size());
  for (const Point& point : points) {
    const auto key = key_of(position(point).template cast<double>() / size);
    voxel_of.push_back(kNone);
    if (!key) continue;
    const auto [voxel, is_new] = voxels.find_or_insert(*key);
    if (is_new) {
      voxel.number = static_cast<std::uint32_t>(left.size());
      left.push_back(0);
    }
    voxel_of.back() = voxel.number;
    ++left[voxel.number];
  }
  for (std::uint32_t number = 0; number < left.size(); ++number) {
    // Multiplicative hashing by the golden ratio spreads the numbers evenly over 32 bits.
    const std::uint32_t share = number * 2654435769u;
    left[number] = 1 + static_cast<std::uint32_t>(std::uint64_t{share} * left[number] >> 32);
  }
  std::vector<Point> kept;
  kept.reserve(left.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (voxel_of[i] != kNone && --left[voxel_of[i]] == 0) kept.push_back(points[i]);
  return kept;
}

/// The sets of maps (kMapSets), each with one point per voxel of `size` m (0 keeps all points).
Features voxel_filter(const Features& features, double size);

}  // namespace lego_loam_sc
