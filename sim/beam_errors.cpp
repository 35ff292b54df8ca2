// SPDX-License-Identifier: BSD-3-Clause
#include "sim/beam_errors.hpp"

#include "sim/random.hpp"

namespace lego_loam_sc {

BeamErrors used_beams(int rows, std::uint64_t seed) {
  BeamErrors errors;
  Random random(seed);
  for (int row = 0; row < rows; ++row) {
    errors.elevation_deg.push_back(0.19 + 0.04 * random.gaussian());
    errors.range.push_back(0.012 * random.gaussian());
  }
  return errors;
}

}  // namespace lego_loam_sc
