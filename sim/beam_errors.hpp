// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace lego_loam_sc {

/// Errors of the beams of one sensor, constant during a drive. One value per row, or empty: the
/// sensor matches its model.
struct BeamErrors {
  std::vector<double> elevation_deg;  ///< true minus reported elevation
  std::vector<double> range;          ///< m; reported minus true range
};

/// The errors of a used sensor: all beams point 0.19 degrees higher than reported, as those of the
/// KITTI recordings do; beside that each beam is off by 0.04 degrees and 1.2 cm (one sigma).
BeamErrors used_beams(int rows, std::uint64_t seed);

}  // namespace lego_loam_sc
