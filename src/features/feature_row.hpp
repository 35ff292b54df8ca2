// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/sensor_model.hpp"
#include "features/settings.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"

namespace lego_loam_sc {

/// c_th of paper 2.3 (2): the setting, or the roughness of a smooth surface under `noise_factor`
/// sigmas of range noise when that is larger. With |S| neighbours the sum of equation (1) has the
/// variance sigma^2 (|S|^2 + |S|).
class RoughnessThreshold {
 public:
  RoughnessThreshold(const SensorModel& sensor, const FeatureSettings& settings);

  float operator()(float range) const { return std::max(fixed_, noise_metres_ / range); }

  /// The relative range change q per beam above which a flat wall looks like an edge, less a
  /// margin. With n neighbours on each side its roughness is q^2 (n + 1)(2 n + 1) / 6. Such an edge
  /// would move with the sensor. `threshold` is c_th at the point.
  float max_edge_obliqueness(float threshold) const { return 0.8f * std::sqrt(threshold / wall_); }

 private:
  float wall_;  // roughness of a flat wall divided by q^2
  float fixed_;
  float noise_metres_;  // roughness by noise times range
};

enum class Pick : std::uint8_t { none, edge_large, edge_sharp, planar_large, planar_flat };

/// The points of one row that segmentation kept and their properties, one array entry per point.
/// One object is reused for all rows to save allocations.
struct FeatureRow {
  std::vector<std::uint32_t> index;  ///< into the image
  std::vector<float> range;          ///< m
  std::vector<std::uint16_t> column;
  std::vector<Label> label;
  std::vector<std::uint8_t> gap_before;  ///< 1: no neighbour of the previous point (of the first:
                                         ///< of the last point of the row)
  std::vector<float> threshold;          ///< c_th
  std::vector<float> roughness;          ///< equation (1)
  std::vector<std::uint8_t> blocked;     ///< 1: cannot be a feature
  std::vector<std::uint8_t> oblique;     ///< 1: cannot be an edge
  std::vector<std::uint8_t> smooth;      ///< 1: below c_th and not blocked; set by the selection
  std::vector<std::uint8_t> used;        ///< 1: cannot be picked any more; set by the selection
  std::vector<Pick> pick;                ///< initially none

  int size() const { return static_cast<int>(index.size()); }

  /// Loads row `number` of the image.
  void load(const RangeImage& image, const Segmentation& segmentation, int number,
            const FeatureSettings& settings, const RoughnessThreshold& c_th);
};

}  // namespace lego_loam_sc
