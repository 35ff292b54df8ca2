// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {

constexpr double kCeiling = 2.8;  ///< m; clear height of every storey

/// A speed bump across an aisle along x, or, with a negative height, the hollow of a gully.
struct Bump {
  double x, y;    ///< of its middle, m
  double height;  ///< m
};

/// A gap in an outer wall, where a ramp begins.
struct Opening {
  Eigen::Vector2d middle;  ///< on the wall's line, m
  double width;            ///< m
};

/// Bays side by side along x.
struct BayBlock {
  double start;  ///< x of the first bay's edge, m
  int bays;
};

/// A stair core or a store that stands in the hall, with a door towards the hall's middle.
struct Core {
  Eigen::Vector2d middle, size;  ///< m
};

/// The plan of one storey of a car park, m: a hall from (0, 0) to (length, width) whose floor is at
/// z = 0. Aisles run along x, cross aisles along y.
struct StoreyPlan {
  double length, width;
  std::vector<double> aisles, cross_aisles;           ///< their middles, y and x, ascending
  std::vector<double> bay_rows;                       ///< y of the middles of the bays
  std::vector<BayBlock> bay_blocks;                   ///< the same in every row
  std::vector<double> square_columns, round_columns;  ///< y of their rows; in x between the bays
  std::vector<Core> cores;
  std::vector<Opening> openings;
  std::vector<Bump> bumps;  ///< apart from one another
};

/// Height of the storey's floor (m), outside the hall too. Its slope is continuous.
double floor_height(const StoreyPlan& plan, double x, double y);

/// Adds the storey: floor with bumps, ceiling with beams, walls in relief, cores, cars in three
/// bays of four, columns, pipes, lamps and signs. `building` decides what is built and `cars` what
/// is parked; they may be the same.
void add_storey(Mesh& mesh, const StoreyPlan& plan, Random& building, Random& cars);

}  // namespace lego_loam_sc
