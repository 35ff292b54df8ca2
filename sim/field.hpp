// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace lego_loam_sc {

/// Open, gently rolling grassland with single trees and bushes, a dozen or two of them within
/// sight. The drive is a bent loop of some 350 m at 3 m/s that ends exactly at its start.
World make_field(std::uint64_t seed);

}  // namespace lego_loam_sc
