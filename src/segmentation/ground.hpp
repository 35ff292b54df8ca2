// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "segmentation/settings.hpp"

namespace lego_loam_sc {

/// Sets the label of ground points. Column by column upwards: two rows that see a surface with a
/// slope below the limit are ground when the lower one continues the ground of that column or lies
/// near the plane that the sensor stands on.
void mark_ground(const RangeImage& image, const SensorModel& sensor, double sensor_height,
                 const SegmentationSettings& settings, std::vector<Label>& label);

/// Height of the sensor above the ground, m: the depth at which most level surface near the
/// vehicle lies; nothing when too little of it is in sight.
std::optional<double> estimate_sensor_height(const RangeImage& image, const SensorModel& sensor,
                                             const SegmentationSettings& settings);

}  // namespace lego_loam_sc
