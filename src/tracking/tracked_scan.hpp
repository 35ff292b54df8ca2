// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/pose.hpp"
#include "core/status.hpp"
#include "key_frames/tracked_key_frame.hpp"
#include "mapping/mapper.hpp"
#include "odometry/odometry.hpp"
#include "tracking/front_end.hpp"
#include "tracking/stage_timer.hpp"
#include "tracking/witness.hpp"

namespace lego_loam_sc {

/// Sizes of what the front end found in a scan.
struct ScanCounts {
  std::size_t points = 0, ground_points = 0, segment_points = 0;
  int clusters = 0;
  std::size_t edges_sharp = 0, planars_flat = 0, edges_large = 0, planars_large = 0;
};

/// Counts points, clusters and features.
ScanCounts counts_of(const FrontEnd& front_end);

/// A scan after paper 2.3 (1) to (4).
struct TrackedScan {
  int index = 0;  ///< of the scan, from 0
  std::int64_t stamp_ns = 0;
  double stamp_jump_s = 0.0;  ///< see ScanTime
  Status status = Status::ok;
  ScanCounts counts;    // (1), (2)
  Motion motion;        // (3)
  bool mapped = false;  ///< the scan's turn to be matched with the map and added to it
  MapMatch match;       // (4), as found; nothing when not mapped or while the map is empty
  double elevation_bias_deg = 0.0;  ///< correction of the elevation angles, from the next scan on
  double prediction_m = 0.0;        ///< from the predicted to the found position
  Testimony testimony;              ///< of points that did not serve to find the pose

  /// Poses at the stamp: live, before any loop, and in the frame of the last key frame, which may
  /// be this scan. That frame has the LiDAR's axes turned level.
  /// @{
  Pose T_odom_lidar = Pose::Identity();
  int last_key_frame = -1;
  Pose T_key_lidar = Pose::Identity();
  /// @}
  int fragment = 0;                          ///< of the drive, from 0; see MapFragments
  std::optional<TrackedKeyFrame> key_frame;  ///< when the scan is one

  /// The drive began at speed: the first scan, tracked anew with the motion that this, the second
  /// scan, has shown. It replaces the result of the first, and its key frame is key frame 0.
  std::shared_ptr<const TrackedScan> first_again;

  std::array<double, kStages> milliseconds{};  ///< wall time by stage
};

}  // namespace lego_loam_sc
