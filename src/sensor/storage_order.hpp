// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/scan.hpp"

namespace lego_loam_sc {

/// Larger ring numbers mean a corrupt field.
constexpr int kMaxRings = 4096;

/// The ring of every point by storage order, -1 where `usable` is 0. KITTI stores ring after ring,
/// each counter-clockwise from straight ahead, so a new ring starts where the azimuth passes from
/// the fourth quadrant to the first after points behind the sensor. Empty when there are more than
/// `kMaxRings`.
std::vector<std::int16_t> rings_of_storage_order(const Scan& scan,
                                                 const std::vector<std::uint8_t>& usable);

}  // namespace lego_loam_sc
