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

/// c_th of paper 2.3 (2): the setting, or what `noise_factor` sigmas of range noise make of a
/// smooth surface. With |S| neighbours the sum of equation (1) has the variance
/// sigma^2 (|S|^2 + |S|).
class RoughnessThreshold {
 public:
  RoughnessThreshold(const SensorModel& sensor, const FeatureSettings& settings);

  float operator()(float range) const { return std::max(fixed_, noise_metres_ / range); }

  /// A flat wall whose range changes by the share q from one beam to the next has a roughness of
  /// q^2 (n + 1)(2 n + 1) / 6 with n neighbours on each side: above this q, less a margin, it would
  /// pass for an edge, which travels along with the sensor. `threshold` is c_th at the point.
  float oblique(float threshold) const { return 0.8f * std::sqrt(threshold / wall_); }

 private:
  float wall_;  // roughness of a flat wall over q^2
  float fixed_;
  float noise_metres_;  // roughness times range
};

enum class Pick : std::uint8_t { none, edge_large, edge_sharp, planar_large, planar_flat };

/// The points of one row that segmentation kept, and what is found out about them: arrays with one
/// entry for each point. One object serves for all rows, so that its memory is taken once.
struct FeatureRow {
  std::vector<std::uint32_t> index;  ///< into the image
  std::vector<float> range;          ///< m
  std::vector<std::uint16_t> column;
  std::vector<Label> label;
  std::vector<std::uint8_t>
      gap_before;                     ///< no neighbour of the point before, of the first the last
  std::vector<float> threshold;       ///< c_th
  std::vector<float> roughness;       ///< equation (1)
  std::vector<std::uint8_t> blocked;  ///< makes no feature
  std::vector<std::uint8_t> oblique;  ///< makes no edge
  std::vector<std::uint8_t> smooth;   ///< below c_th and not blocked; for the selection to fill in
  std::vector<std::uint8_t> used;     ///< may not be picked any more; the same
  std::vector<Pick> pick;             ///< none at first

  int size() const { return static_cast<int>(index.size()); }

  /// Becomes row `number` of the image.
  void take(const RangeImage& image, const Segmentation& segmentation, int number,
            const FeatureSettings& settings, const RoughnessThreshold& c_th);
};

}  // namespace lego_loam_sc
