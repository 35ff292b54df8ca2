// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/mesh.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {

/// Dimensions of a house.
struct House {
  double width, depth;  ///< m
  int storeys;
};

/// A house with windows and doors set back in all four walls, sills, a plinth, pilasters or
/// downpipes and a parapet: relief that constrains a scan along the street. `T_world_house` places
/// the middle of its front at street level; x runs along the front, y to the back.
void add_house(Mesh& mesh, const Pose& T_world_house, const House& house, Random& random);

}  // namespace lego_loam_sc
