// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"

namespace lego_loam_sc {

/// Marks the returns of a scan that hang in the air in front of what their neighbours see, as dust,
/// snow and spray do, in `remove` (one entry per point); returns their number. A return is isolated
/// when no neighbour in the image could lie on the same surface, however slanted.
std::size_t mark_isolated_returns(const RangeImage& image, const SensorModel& sensor,
                                  std::vector<std::uint8_t>& remove);

}  // namespace lego_loam_sc
