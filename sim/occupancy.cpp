// SPDX-License-Identifier: BSD-3-Clause
#include "sim/occupancy.hpp"

#include <algorithm>
#include <cmath>

#include "sim/geometry.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;

constexpr double kCell = 0.5;  // m
constexpr double kStep = 0.4;  // m between the looks at a footprint

}  // namespace

Occupancy::Occupancy(const LaneMap& lanes)
    : lanes_(lanes),
      low_(lanes.corner(0, 0)),
      nx_(static_cast<int>((lanes.corner(lanes.columns() - 1, 0) - low_).x() / kCell) + 1),
      ny_(static_cast<int>((lanes.corner(0, lanes.rows() - 1) - low_).y() / kCell) + 1),
      taken_(static_cast<std::size_t>(nx_) * ny_, false) {}

std::size_t Occupancy::cell_of(const Vector2d& place) const {
  const Vector2d p = (place - low_) / kCell;
  const int i = static_cast<int>(std::clamp(p.x(), 0.0, nx_ - 1.0));
  const int j = static_cast<int>(std::clamp(p.y(), 0.0, ny_ - 1.0));
  return static_cast<std::size_t>(i) * ny_ + j;
}

template <class Visit>
bool Occupancy::every_place(const Footprint& f, Visit visit) const {
  const Vector2d across = left_of(f.along);
  const int n = static_cast<int>(std::ceil(f.length / kStep));
  const int m = static_cast<int>(std::ceil(f.width / kStep));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j)
      if (!visit(f.middle + (i / static_cast<double>(n) - 0.5) * f.length * f.along +
                 (j / static_cast<double>(m) - 0.5) * f.width * across))
        return false;
  return true;
}

bool Occupancy::take(const Footprint& footprint, double from_lanes) {
  const bool free = every_place(footprint, [&](const Vector2d& place) {
    return !taken_[cell_of(place)] && lanes_.distance(place) >= from_lanes;
  });
  if (free)
    every_place(footprint, [&](const Vector2d& place) {
      taken_[cell_of(place)] = true;
      return true;
    });
  return free;
}

}  // namespace lego_loam_sc
