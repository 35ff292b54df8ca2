// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/pose.hpp"
#include "key_frames/key_frame.hpp"
#include "registration/localizability.hpp"

namespace lego_loam_sc {

/// A key frame as the tracker hands it to the back end; all that the back end learns of a scan.
struct TrackedKeyFrame {
  int number = 0;  ///< 0, 1, ... in the order of time
  int scan = 0;    ///< index of its scan
  KeyFrame key_frame;
  std::vector<Eigen::Vector3f> points;  ///< all, de-skewed, LiDAR frame; the scan context's
  double sensor_height = 0.0;           ///< m above the ground, 0 = unknown

  /// Where the tracker has it, and from the last key frame. Key frame 0 has no last one.
  /// @{
  Pose T_map_key = Pose::Identity();
  Pose T_last_key = Pose::Identity();
  /// @}
  /// Its covariance and localizability as the match with the map gave them, see MapMatch.
  /// @{
  Matrix6 covariance = Matrix6::Zero();
  Localizability localizability;
  /// @}
  bool starts_fragment = false;  ///< tracking was lost: T_last_key is a guess, see MapFragments
};

}  // namespace lego_loam_sc
