// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "features/features.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "slam/settings.hpp"

namespace lego_loam_sc {

/// The smallest of the sets of paper 2.3 (2) that a point is in.
enum class FeatureSet : std::uint8_t { none, planar_large, planar_flat, edge_large, edge_sharp };

/// What the front end makes of one scan (the paper's figure 9). The arrays have one entry for each
/// point of the image.
struct ScanStages {
  RangeImage image;
  SensorModel sensor;          ///< as given, with the tilt that was found
  double sensor_height = 0.0;  ///< m; 0 = unknown
  Segmentation segmentation;
  Features features;
  std::vector<float> roughness;  ///< equation (1); kNoRoughness where it is not defined
  std::vector<float> sharpness;  ///< roughness over the threshold c_th: above 1 it is an edge's
  std::vector<FeatureSet> feature_set;
};

/// The scan is taken as if the sensor stood still. Its points are turned level, as in a run, when
/// they show that the sensor is tilted.
ScanStages make_stages(const Scan& scan, const SensorModel& sensor, const Settings& settings);

}  // namespace lego_loam_sc
