// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "segmentation/settings.hpp"

namespace lego_loam_sc {

/// Labels ground points. Each column is walked upwards: two rows with a slope below the limit are
/// ground when the lower one continues the ground of the column or lies near the plane that the
/// sensor stands on.
void mark_ground(const RangeImage& image, const SensorModel& sensor, double sensor_height,
                 const SegmentationSettings& settings, std::vector<Label>& label);

/// Height of the sensor above the ground, m: the mode of the depths of level surfaces near the
/// vehicle; nothing when too few are visible.
std::optional<double> estimate_sensor_height(const RangeImage& image, const SensorModel& sensor,
                                             const SegmentationSettings& settings);

}  // namespace lego_loam_sc
