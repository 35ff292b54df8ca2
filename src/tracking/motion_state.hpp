// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/pose.hpp"

namespace lego_loam_sc {

/// Where a scan is at its reference time.
struct ScanState {
  std::int64_t reference_ns = 0;
  Pose T_map_lidar = Pose::Identity();   ///< corrected by loops
  Pose T_odom_lidar = Pose::Identity();  ///< the same motions, never corrected
  Vector6 twist = Vector6::Zero();       ///< of the sensor in its own axes, m/s and rad/s

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(reference_ns, T_map_lidar, T_odom_lidar, twist);
  }
};

/// Where the sensor was last, and how it moves.
struct MotionState {
  ScanState previous;               ///< the last scan whose place was found
  Vector6 twist = Vector6::Zero();  ///< between it and the one before, in its axes
  bool known = false;               ///< false: at rest is all that can be assumed
  double speed = 0.0;               ///< m/s, exponential mean over well-constrained scans
  double travelled = 0.0;           ///< m

  /// The motion of the next `seconds` at constant velocity.
  Pose predicted_motion(double seconds) const;

  /// Where that motion leads at the mean speed, in the direction of the last displacement in map
  /// axes: vibration would rotate the direction in the axes of the sensor.
  Pose T_map_predicted(double seconds) const;

  /// Takes a displacement (m) of `seconds` into the distance travelled and, when it is measured in
  /// all directions, into the mean speed.
  void add_displacement(double metres, double seconds, bool constrained);

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(previous, twist, known, speed, travelled);
  }
};

}  // namespace lego_loam_sc
