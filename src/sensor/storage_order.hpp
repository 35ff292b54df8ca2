// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/scan.hpp"

namespace lego_loam_sc {

/// No spinning sensor has so many; what counts more is no ring number.
constexpr int kMostRings = 4096;

/// The ring of every point by the order of storage, -1 where `usable` is 0: KITTI stores ring after
/// ring, each swept counter-clockwise from straight ahead, so a new ring starts where the azimuth
/// passes from the fourth quadrant to the first, with points behind the sensor in between. Nothing
/// when that gives more than `kMostRings`.
std::vector<std::int16_t> rings_of_storage_order(const Scan& scan,
                                                 const std::vector<std::uint8_t>& usable);

}  // namespace lego_loam_sc
