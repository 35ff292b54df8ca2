// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/trajectory.hpp"

namespace lego_loam_sc {

/// A drive of some 3.7 km and 7.5 minutes through the streets of a residential quarter on a hill,
/// ten poses a second: crossings, bends and stops at up to 12 m/s, streets driven twice in the same
/// and in the opposite direction, its end near its start.
Trajectory make_city_route();

}  // namespace lego_loam_sc
