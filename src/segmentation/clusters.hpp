// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "segmentation/settings.hpp"

namespace lego_loam_sc {

/// Clusters the points that are not ground: neighbours in a row or a column belong to one object
/// when the line through them makes an angle beta above the limit with the farther beam
/// (Bogoslavskyi and Stachniss, 2016). Points of clusters that are large enough, or thin and tall,
/// get the label `segment` and the cluster's number in `cluster`. Returns the number of clusters.
int mark_clusters(const RangeImage& image, const SensorModel& sensor,
                  const SegmentationSettings& settings, std::vector<Label>& label,
                  std::vector<std::int32_t>& cluster);

}  // namespace lego_loam_sc
