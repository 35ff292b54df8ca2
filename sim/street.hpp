// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace lego_loam_sc {

/// A quarter of a town on gentle slopes: slightly curved streets round blocks of houses with
/// facades in relief, kerbs, front gardens, parked cars, trees, lamps and signs. The drive is a
/// closed loop of some 1.1 km round two blocks at up to 9 m/s; it ends on its first street, in the
/// same direction, 70 m past its start.
World make_street(std::uint64_t seed);

}  // namespace lego_loam_sc
