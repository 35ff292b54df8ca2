// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace lego_loam_sc {

// Underground car parks, driven at walking speed by a small tracked vehicle that shakes.

/// One storey, 80 m x 50 m, 2.8 m high: three aisles joined by three cross aisles, bays mostly
/// occupied, columns, beams, pipes, speed bumps, a stair core and the foot of a ramp. The drive is
/// a figure of eight of some 260 m; it passes its start once and ends exactly there.
World make_parking(std::uint64_t seed);

/// The paper's scene #1: one storey, 76 m x 50 m, with speed bumps and gullies. The drive goes once
/// round the hall, 180 m; it starts in front of an entrance and ends exactly there.
World make_parking1(std::uint64_t seed);

/// The paper's scene #2: two storeys of 65 m x 50 m, 3.2 m apart, built alike to the last pipe but
/// parked with other cars, and a ramp down beside a ramp up. The drive of 195 m goes along an
/// aisle, down, along the same aisle one storey below, up, and ends exactly at its start.
World make_parking2(std::uint64_t seed);

}  // namespace lego_loam_sc
