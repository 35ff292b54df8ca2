// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/lane_map.hpp"
#include "sim/uniform_spline.hpp"

namespace lego_loam_sc {

// The cross-section of a street, m. A lane is the line that the middle of a vehicle follows;
// everything else keeps its distance from the nearest lane.
constexpr double kLaneOffset = 3.2;  ///< between the lanes of the two directions
constexpr double kParkedCar = 2.45;  ///< to the middle of a parked car
constexpr double kKerbLine = 3.45;   ///< to the kerb
constexpr double kVerge = 3.95;      ///< to trees, lamps and signs
constexpr double kFenceLine = 5.6;   ///< to the edge of the plots
constexpr double kKerbHeight = 0.12;

/// A street with a lane for each direction.
struct Street {
  Polyline line;       ///< every metre
  double left, right;  ///< m from the line to the outermost lane on either side
};

/// Points of a line on its left (m, negative: right), where neighbours do not turn back.
Polyline shifted(const Polyline& line, double left);

/// The lanes of all streets.
std::vector<Polyline> lanes_of(const std::vector<Street>& streets);

/// The streets of a city through which `path` leads on the right-hand lane: first the street of the
/// path itself, then those that open from it, straight on at its bends and to the sides between.
std::vector<Street> make_streets(const UniformSpline<Eigen::Vector2d>& path, std::uint64_t seed);

}  // namespace lego_loam_sc
