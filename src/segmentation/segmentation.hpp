// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/settings.hpp"

namespace lego_loam_sc {

enum class Label : std::uint8_t {
  outlier,  ///< in no cluster of sufficient size: noise, foliage
  ground,
  segment,  ///< in a cluster
};

/// Ground, cluster or outlier: the class of each point of a range image. Paper 2.1 and 2.3 (1).
struct Segmentation {
  std::vector<Label> label;           ///< one per point of the image
  std::vector<std::int32_t> cluster;  ///< 0, 1, ... in order of first point; -1 for no `segment`
  int clusters = 0;
  std::size_t ground_points = 0;
  std::size_t segment_points = 0;
};

/// Labels the ground first, then clusters the remaining points. `sensor_height` is the sensor's
/// height above the ground, m; 0 = unknown.
Segmentation segment(const RangeImage& image, const SensorModel& sensor, double sensor_height,
                     const SegmentationSettings& settings);

}  // namespace lego_loam_sc
