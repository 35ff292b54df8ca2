// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/pose.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// Finds what the elevation angle of each row of the sensor is off by, beside the error that all
/// have in common (ElevationBias). A surface of the map is an average over the rows that have seen
/// it, so a row that is off lies above or below the surfaces that it meets, by its error times the
/// range.
class RowBias {
 public:
  /// Takes the residuals of a scan that was matched with the map; `scale` of the robust kernel,
  /// sigmas.
  void add(std::span<const Correspondence> correspondences, const Pose& T_map_lidar, double scale);

  /// rad, for each row so far seen: to be added to the elevation angle of its points on top of what
  /// was added to those of the scans so far. Their mean, weighted by how well they are known, is 0.
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
