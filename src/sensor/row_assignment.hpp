// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"

namespace lego_loam_sc {

/// The row (0 = lowest beam) of every point, or -1 for none: from the ring field when there is one,
/// from the storage order when the points are stored ring by ring as in KITTI's files, from the
/// elevation table otherwise. `usable[i]` says whether point i has a finite position.
std::vector<std::int16_t> assign_rows(const Scan& scan, const std::vector<std::uint8_t>& usable,
                                      const SensorModel& sensor);

/// The row of each ring from its elevation (rad; NaN for a ring without points, whose row is -1):
/// the order-preserving assignment to the beams with the smallest sum of differences, so that a
/// missing ring does not shift the others. Nothing when there are no rings or more than beams.
std::optional<std::vector<std::int16_t>> align_to_beams(const std::vector<double>& elevation,
                                                        const SensorModel& sensor);

}  // namespace lego_loam_sc
