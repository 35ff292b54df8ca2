// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace lego_loam_sc {

/// One storey of an underground car park, 80 m x 50 m, 2.8 m high: three aisles joined by three
/// cross aisles, bays mostly occupied, columns, beams, pipes, speed bumps, a stair core and the
/// foot of a ramp. The drive is a figure of eight of some 260 m at walking speed on a vehicle that
/// shakes; it passes its start once and ends exactly there.
World make_car_park(std::uint64_t seed);

}  // namespace lego_loam_sc
