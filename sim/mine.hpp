// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace lego_loam_sc {

/// A mine: a loop of 600 m of arched roadways about 5 m wide with rough walls, in a seam that rises
/// and falls by up to 5 degrees, three cross-cuts between pillars and four dead ends; pipes, a belt
/// conveyor, steel arches, props, cabinets and loaders. The drive goes once round the loop at
/// 2.5 m/s, shaken by the floor, and on over the first 40 m of it, where it ends.
World make_mine(std::uint64_t seed);

}  // namespace lego_loam_sc
