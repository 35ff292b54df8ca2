// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/trajectory.hpp"
#include "sim/world.hpp"

namespace lego_loam_sc {

/// A city round a route (see read_route in io/trajectory.hpp): its streets follow the route, with kerbs, pavements,
/// parked cars, trees, lamps, houses and gardens, and open into side streets. The vehicle moves as
/// on the route, smoothed; the ground climbs as the route does, but a place has one height however
/// often it is passed. Throws InputError when no vehicle drives like that.
World make_city(std::uint64_t seed, const Trajectory& route);

/// The city round the route of make_city_route.
World make_kitti00(std::uint64_t seed);

}  // namespace lego_loam_sc
