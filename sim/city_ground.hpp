// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/lane_map.hpp"
#include "sim/mesh.hpp"
#include "sim/terrain.hpp"

namespace lego_loam_sc {

/// The ground of a city over the whole map: roads on the terrain, kerbs at `kKerbLine` from the
/// lanes, and behind them pavements and plots, raised by `kKerbHeight`.
void add_city_ground(Mesh& mesh, const LaneMap& lanes, const Terrain& terrain);

}  // namespace lego_loam_sc
