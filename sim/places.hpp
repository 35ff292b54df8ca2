// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/trajectory.hpp"
#include "sim/world.hpp"

namespace lego_loam_sc {

// The worlds. Each is determined by its seed.

// Underground car parks, driven at walking speed by a small tracked vehicle that shakes.

/// One storey, 80 m x 50 m, 2.8 m high: three aisles joined by three cross aisles, bays mostly
/// occupied, columns, beams, pipes, speed bumps, a stair core and the foot of a ramp. The drive is
/// a figure of eight of some 260 m; it passes its start once and ends exactly there.
World make_parking(std::uint64_t seed);

/// The paper's scene #1: one storey, 76 m x 50 m, with speed bumps and gullies. The drive goes once
/// round the hall, 180 m; it starts in front of an entrance and ends exactly there.
World make_parking1(std::uint64_t seed);

/// The paper's scene #2: two storeys of 65 m x 50 m, 3.2 m apart, identical except for the parked
/// cars, and a ramp down beside a ramp up. The drive of 195 m goes along an aisle, down, along the
/// same aisle one storey below, up, and ends exactly at its start.
World make_parking2(std::uint64_t seed);

/// A city along a route (see read_route in io/trajectory.hpp): its streets follow the route, with
/// kerbs, pavements, parked cars, trees, lamps, houses and gardens, and have side streets. The
/// vehicle moves along the smoothed route. The ground follows the heights of the route, averaged
/// where it passes a place again. Throws InputError when no vehicle can drive the route.
World make_city(std::uint64_t seed, const Trajectory& route);

/// The city along the route of make_city_route.
World make_kitti00(std::uint64_t seed);

/// Open, gently rolling grassland with single trees and bushes, a dozen or two of them within
/// sight. The drive is a bent loop of some 350 m at 3 m/s that ends exactly at its start.
World make_field(std::uint64_t seed);

/// A mine: a loop of 600 m of arched roadways about 5 m wide with rough walls, in a seam that rises
/// and falls by up to 5 degrees, three cross-cuts between pillars and four dead ends; pipes, a belt
/// conveyor, steel arches, props, cabinets and loaders. The drive goes once round the loop at
/// 2.5 m/s, shaken by the floor, and on over the first 40 m of it, where it ends.
World make_mine(std::uint64_t seed);

/// A quarter of a town on gentle slopes: slightly curved streets round blocks of houses with
/// facades in relief, kerbs, front gardens, parked cars, trees, lamps and signs. The drive is a
/// closed loop of some 1.1 km round two blocks at up to 9 m/s; it ends on its first street, in the
/// same direction, 70 m past its start.
World make_street(std::uint64_t seed);

/// A straight, smooth bore of constant arched section, 5.2 m wide and 4.3 m high, along x. Over the
/// first 15 m of the drive there are niches with cabinets in the walls, none of which reaches into
/// the bore; the 300 m that follow, and more than the sensor's range beyond both ends of the drive,
/// have a constant cross-section. The drive is straight, 315 m at 2 m/s from rest to rest: its
/// speed is observable only until it leaves the niches.
World make_tunnel(std::uint64_t seed);

}  // namespace lego_loam_sc
