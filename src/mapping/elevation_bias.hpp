// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/pose.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// Finds a common error of all elevation angles of the sensor while it drives.
///
/// An error of 0.2 degrees, as KITTI's scans have it, turns flat ground into a cone: too low by the
/// error times the range. Matching two cones that are some way apart asks for a pitch, and the road
/// bends by a degree in 100 m, loops or not. But a pitch does not fit well: a place of the map was
/// seen from other ranges than the point that meets it now, and what the pose leaves of the
/// residuals follows the difference of the two ranges.
class ElevationBias {
 public:
  /// Takes the residuals of a scan that was matched with the map. `solution`: normal equations of
  /// all that determined the pose and the velocity of the sweep, there; `scale`: of the robust
  /// kernel, sigmas.
  void add(std::span<const Correspondence> correspondences, const Pose& T_map_lidar, double scale,
           const NormalEquations<12>& solution);

  /// rad, to be added to the elevation angle of every point on top of what was added to the points
  /// of the scans so far.
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
