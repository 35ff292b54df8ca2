// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"

namespace lego_loam_sc {

/// Finds the points that simulators and some drivers give at one range, often the maximum, in all
/// directions without a return. Such a sphere round the sensor moves with it and is no surface: no
/// plane keeps its range over a wide angle, and a ground or an upright cylinder does so along a row
/// alone.
class FillerShell {
 public:
  /// Knows no fillers yet.
  explicit FillerShell(const SensorModel& sensor);

  /// Looks for fillers in the next scan. What some scans have shown is known from then on, where
  /// fillers are few as well.
  void observe(const RangeImage& image);

  /// Marks the fillers of the scan that was observed last in `remove` (one entry per point);
  /// returns their number.
  std::size_t mark(const RangeImage& image, std::vector<std::uint8_t>& remove) const;

  /// m; of the fillers, once some scans have shown them.
  std::optional<double> range() const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(range_, shown_, scans_);
  }

 private:
  std::optional<float> find(const RangeImage& image) const;
  bool is_sphere(const RangeImage& image, float range, int count) const;

  std::vector<double> elevation_deg_;
  float half_width_;    // m, of the shell
  float range_ = 0.0F;  // m, mean of those that were found
  bool shown_ = false;  // by the last scan, or known
  int scans_ = 0;       // in a row that showed it; kKnown at most
};

}  // namespace lego_loam_sc
