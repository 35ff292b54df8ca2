// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/lane_map.hpp"

namespace lego_loam_sc {

/// The footprint of an object in the horizontal plane.
struct Footprint {
  Eigen::Vector2d middle;
  Eigen::Vector2d along;  ///< of length 1
  double length, width;   ///< m, along and across
};

/// Occupied area of the ground, so that objects intersect neither each other nor lanes.
class Occupancy {
 public:
  explicit Occupancy(const LaneMap& lanes);

  /// Occupies the footprint and returns true when all of it is free and at least `from_lanes` (m)
  /// away from every lane.
  bool take(const Footprint& footprint, double from_lanes);

 private:
  template <class Visit>
  bool every_place(const Footprint& footprint, Visit visit) const;
  std::size_t cell_of(const Eigen::Vector2d& place) const;

  const LaneMap& lanes_;
  Eigen::Vector2d low_;
  int nx_, ny_;
  std::vector<bool> taken_;
};

}  // namespace lego_loam_sc
