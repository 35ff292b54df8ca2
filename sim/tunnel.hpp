// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace lego_loam_sc {

/// A straight, smooth bore of constant arched section, 5.2 m wide and 4.3 m high, along x. Over the
/// first 15 m of the drive there are niches with cabinets in the walls, none of which reaches into
/// the bore; the 300 m that follow, and more than the sensor's range beyond both ends of the drive,
/// are exactly the same all along. The drive is straight, 315 m at 2 m/s from rest to rest: its
/// speed can be seen as it leaves the niches and never again.
World make_tunnel(std::uint64_t seed);

}  // namespace lego_loam_sc
