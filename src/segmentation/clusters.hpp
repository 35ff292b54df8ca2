// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "segmentation/settings.hpp"

namespace lego_loam_sc {

/// Image segmentation of the points that are not ground: neighbours in a row or a column are one
/// object when the line through them makes an angle beta above the limit with the farther beam
/// (Bogoslavskyi and Stachniss, 2016). Sets `segment` on the points of clusters that are large
/// enough, or thin and tall, and their number in `cluster`; returns the count of such clusters.
int mark_clusters(const RangeImage& image, const SensorModel& sensor,
                  const SegmentationSettings& settings, std::vector<Label>& label,
                  std::vector<std::int32_t>& cluster);

}  // namespace lego_loam_sc
