// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/pose.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// Estimates a common error of all elevation angles of the sensor during the run.
///
/// An error of 0.2 degrees, as in KITTI's scans, turns flat ground into a cone: its height is off
/// by the error times the range. Matching cones of different poses yields a false pitch, and the
/// trajectory bends by a degree per 100 m, even with loops. A pitch does not explain the residuals
/// fully, though: a surface of the map was measured at other ranges than the point that is matched
/// with it now, and the remaining residuals are proportional to the difference of the ranges.
class ElevationBias {
 public:
  /// Updates the estimate with the residuals of a matched scan. `solution`: the normal equations of
  /// pose and velocity at the solution, priors included; `scale`: of the robust kernel, sigmas.
  void add(std::span<const Correspondence> correspondences, const Pose& T_map_lidar, double scale,
           const NormalEquations<12>& solution);

  /// rad, the correction to add to the elevation angle of every point in addition to the correction
  /// that the past scans already had.
  double value() const { return value_; }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(value_, information_);
  }

 private:
  double value_ = 0.0;
  double information_ = 0.0;  // of all scans, 1/rad^2
};

}  // namespace lego_loam_sc
