// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/sensor_model.hpp"
#include "features/settings.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"

namespace lego_loam_sc {

/// A feature: a point of an edge, a plane or a scattered object.
struct FeaturePoint {
  Eigen::Vector3f position;  ///< LiDAR frame at the time of the point, m
  float time = 0.0f;         ///< s after the scan's reference time
  float intensity = 0.0f;    ///< in the sensor's own unit
  std::uint16_t row = 0;
  std::uint16_t column = 0;
  Label label = Label::segment;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(position, time, intensity, row, column, label);
  }
};

/// The feature sets of paper 2.3 (2). The small sets hold the sharpest edges and the flattest
/// points, F_e and F_p; the large sets, with a double-struck F in the paper, contain them. What
/// stands on the ground but is neither a clear edge nor smooth (vegetation, poles, people, small
/// structures) often holds more of the pose than the edges do: `scattered`. All sets are in
/// ascending order of row and column.
struct Features {
  std::vector<FeaturePoint> edges_sharp;    ///< F_e
  std::vector<FeaturePoint> planars_flat;   ///< F_p
  std::vector<FeaturePoint> edges_large;    ///< large F_e
  std::vector<FeaturePoint> planars_large;  ///< large F_p
  std::vector<FeaturePoint> scattered;      ///< rough points above the ground
};

/// The sets that maps and key frames consist of.
inline constexpr std::array kMapSets = {&Features::planars_large, &Features::edges_large,
                                        &Features::scattered};

/// At most `count` of the points, evenly spaced in their order.
std::vector<FeaturePoint> subsample(const std::vector<FeaturePoint>& points, int count);

/// Selects features by roughness, evenly over the rows and their sub-images.
Features extract_features(const RangeImage& image, const Segmentation& segmentation,
                          const SensorModel& sensor, const FeatureSettings& settings);

}  // namespace lego_loam_sc
