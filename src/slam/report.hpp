// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"
#include "core/status.hpp"
#include "loop/loop_report.hpp"
#include "tracking/stage_timer.hpp"
#include "tracking/tracked_scan.hpp"

namespace lego_loam_sc {

/// What became of a scan; a row of scans.csv.
struct ScanReport {
  int index = 0;
  std::int64_t stamp_ns = 0;
  double stamp_jump_s = 0.0;  ///< from the stamp before, when that was bridged; see ScanClock
  Status status = Status::ok;
  Pose T_odom_lidar = Pose::Identity();  ///< live pose at the stamp, before any loop

  std::size_t points = 0;
  std::size_t ground_points = 0;
  std::size_t segment_points = 0;
  int clusters = 0;
  std::size_t edges_sharp = 0, planars_flat = 0, edges_large = 0, planars_large = 0;

  int odometry_edges = 0, odometry_planars = 0, odometry_iterations = 0;

  bool mapped = false;
  int map_points = 0, map_matches = 0, map_iterations = 0;
  double map_rmse = 0.0;  ///< m
  int degenerate_translations = 0, degenerate_rotations = 0;
  double least_translation_strength = 0.0, least_rotation_strength = 0.0;
  double elevation_bias_deg = 0.0;  ///< correction of the elevation angles, from the next scan on

  int agreeing = 0, contradicting = 0;  ///< points, see Testimony
  double prediction_m = 0.0;            ///< from the predicted to the found position

  int piece = 0;       ///< of the drive, from 0; see MapFragments
  int key_frame = -1;  ///< its number when the scan is one
  std::vector<LoopReport> loops;
  bool corrected = false;  ///< a loop came into the pose graph

  std::array<double, kStages> milliseconds{};  ///< wall time by stage
};

/// What became of a scan and of the loops at its key frame.
ScanReport report_of(const TrackedScan& tracked, std::vector<LoopReport> loops);

}  // namespace lego_loam_sc
