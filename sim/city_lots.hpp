// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "sim/city_streets.hpp"
#include "sim/mesh.hpp"
#include "sim/terrain.hpp"

namespace lego_loam_sc {

/// The objects in a city: parked cars, trees, lamps, signs and bollards along the streets,
/// houses with gardens, hedges, walls and gaps on both sides, more houses and trees behind them.
/// Nothing stands within 1.45 m of the middle of a lane. `lanes` is the map of the streets' lanes.
void add_city_lots(Mesh& mesh, const std::vector<Street>& streets, const LaneMap& lanes,
                   const Terrain& terrain, std::uint64_t seed);

}  // namespace lego_loam_sc
