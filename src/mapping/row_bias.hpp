// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/pose.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// Estimates the error of the elevation angle of each row of the sensor, in addition to the common
/// error (ElevationBias). A surface of the map averages over the rows that measured it, so the
/// points of a biased row lie above or below it by the bias times the range.
class RowBias {
 public:
  /// Updates the estimate with the residuals of a matched scan; `scale` of the robust kernel,
  /// sigmas.
  void add(std::span<const Correspondence> correspondences, const Pose& T_map_lidar, double scale);

  /// rad, for each row seen yet: the correction to add to the elevation angle of its points in
  /// addition to that of the past scans. Their mean, weighted by information, is 0.
  const std::vector<double>& values() const { return values_; }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(values_, information_);
  }

 private:
  std::vector<double> values_;
  std::vector<double> information_;  // of all scans, 1/rad^2
};

}  // namespace lego_loam_sc
