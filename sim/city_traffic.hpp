// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/lane_map.hpp"
#include "sim/recorded_track.hpp"
#include "sim/terrain.hpp"
#include "sim/traffic.hpp"

namespace lego_loam_sc {

/// Who else is on the way of a vehicle: a car ahead of it for two parts of the way, cars and
/// cyclists that come towards it on the other lane every 5 to 15 s, and walkers on the pavement.
/// None of them touches another or the vehicle. `lanes` is the map of the streets' lanes.
TrafficPlan make_city_traffic(const Way& way, const Terrain& terrain, const LaneMap& lanes,
                              std::uint64_t seed);

}  // namespace lego_loam_sc
