// SPDX-License-Identifier: BSD-3-Clause
#include "app/scan_stages.hpp"

#include <algorithm>
#include <utility>

#include "features/feature_row.hpp"
#include "features/roughness.hpp"
#include "tracking/front_end.hpp"

namespace lego_loam_sc {
namespace {

// A feature is the point of the image at the same place in the same row.
void mark(const std::vector<FeaturePoint>& features, FeatureSet set, ScanStages& stages) {
  const RangeImage& image = stages.image;
  for (const FeaturePoint& feature : features) {
    const auto begin = image.points.begin() + image.row_begin[feature.row];
    const auto end = image.points.begin() + image.row_begin[feature.row + 1];
    const auto point = std::find(begin, end, feature.position);
    if (point != end) stages.feature_set[point - image.points.begin()] = set;
  }
}

void measure_roughness(const SensorModel& sensor, const FeatureSettings& settings,
                       ScanStages& stages) {
  stages.roughness.assign(stages.image.size(), kNoRoughness);
  stages.sharpness.assign(stages.image.size(), kNoRoughness);
  const RoughnessThreshold c_th(sensor, settings);
  FeatureRow row;
  for (int number = 0; number < stages.image.rows; ++number) {
    row.load(stages.image, stages.segmentation, number, settings, c_th);
    for (int i = 0; i < row.size(); ++i) {
      stages.roughness[row.index[i]] = row.roughness[i];
      stages.sharpness[row.index[i]] = row.roughness[i] / row.threshold[i];
    }
  }
}

}  // namespace

ScanStages make_stages(const Scan& scan, const SensorModel& sensor, const Settings& settings) {
  ScanStages stages;
  FrontEnd front = run_front_end(scan, sensor, sensor.height, settings, true);
  stages.sensor = mounted(sensor, front.mounting);
  stages.sensor_height = front.mounting.height;
  stages.image = std::move(front.image);
  stages.segmentation = std::move(front.segmentation);
  stages.features = std::move(front.features);
  measure_roughness(sensor, settings.features, stages);

  stages.feature_set.assign(stages.image.size(), FeatureSet::none);
  // The small sets are parts of the large ones and come last.
  mark(stages.features.planars_large, FeatureSet::planar_large, stages);
  mark(stages.features.edges_large, FeatureSet::edge_large, stages);
  mark(stages.features.planars_flat, FeatureSet::planar_flat, stages);
  mark(stages.features.edges_sharp, FeatureSet::edge_sharp, stages);
  return stages;
}

}  // namespace lego_loam_sc
