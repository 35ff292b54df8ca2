// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/lane_map.hpp"
#include "sim/recorded_track.hpp"
#include "sim/terrain.hpp"
#include "sim/traffic.hpp"

namespace lego_loam_sc {

/// Traffic along the path of a vehicle: a car ahead of it on two parts of the path, oncoming cars
/// and cyclists on the other lane every 5 to 15 s, and pedestrians on the pavement. None of them
/// touches another or the vehicle. `lanes` is the map of the streets' lanes.
TrafficPlan make_city_traffic(const TrackPath& path, const Terrain& terrain, const LaneMap& lanes,
                              std::uint64_t seed);

}  // namespace lego_loam_sc
