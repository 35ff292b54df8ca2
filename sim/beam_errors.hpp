// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace lego_loam_sc {

/// How the beams of one sensor differ from its model; fixed for a whole drive. One value for each
/// row, or none at all: a sensor as its model says.
struct BeamErrors {
  std::vector<double> elevation_deg;  ///< the beam points so much higher than the sensor reports
  std::vector<double> range;          ///< m; the sensor reports so much more than the true range
};

/// The errors of a used sensor: all beams point 0.19 degrees higher than reported, as those of the
/// KITTI recordings do; beside that each beam is off by 0.04 degrees and 1.2 cm (one sigma).
BeamErrors used_beams(int rows, std::uint64_t seed);

}  // namespace lego_loam_sc
