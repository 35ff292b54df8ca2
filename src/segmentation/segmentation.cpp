// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/segmentation.hpp"

#include <algorithm>

#include "segmentation/clusters.hpp"
#include "segmentation/ground.hpp"

namespace lego_loam_sc {

Segmentation segment(const RangeImage& image, const SensorModel& sensor, double sensor_height,
                     const SegmentationSettings& settings) {
  Segmentation result;
  if (!settings.enabled) {
    result.label.assign(image.size(), Label::segment);
    result.cluster.assign(image.size(), 0);
    result.clusters = image.size() > 0 ? 1 : 0;
    result.segment_points = image.size();
    return result;
  }
  result.label.assign(image.size(), Label::outlier);
  mark_ground(image, sensor, sensor_height, settings, result.label);
  result.clusters = mark_clusters(image, sensor, settings, result.label, result.cluster);
  result.ground_points = std::count(result.label.begin(), result.label.end(), Label::ground);
  result.segment_points = std::count(result.label.begin(), result.label.end(), Label::segment);
  return result;
}

}  // namespace lego_loam_sc
