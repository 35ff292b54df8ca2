// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "core/state_archive.hpp"
#include "core/trajectory.hpp"
#include "loop/loop_detector.hpp"
#include "slam/back_end.hpp"
#include "slam/report.hpp"
#include "slam/settings.hpp"
#include "slam/transform_fusion.hpp"
#include "slam/worker_threads.hpp"
#include "tracking/tracker.hpp"

namespace lego_loam_sc {

/// LeGO-LOAM-SC: takes the scans of one LiDAR in the order of time and keeps the trajectory, the
/// key frames and the pose graph. The map frame is the sensor's frame at the first scan, turned
/// level when the sensor is tilted; poses of scans are those of the LiDAR in it, key frames and the
/// graph have the LiDAR's axes turned level. The same scans and settings give the same results to
/// the bit, for any number of threads.
class Slam {
 public:
  /// `threads` bounds all threads that work is spread over; `detector` looks for loops beside those
  /// that the settings switch on; `points` takes the points of the key frames, memory when there is
  /// none. Throws std::invalid_argument when the sensor or a setting is not valid.
  Slam(const SensorModel& sensor, const Settings& settings, int threads = 1,
       LoopDetector detector = {}, std::shared_ptr<BlobStore> points = {});

  /// Processes the next scan. Whatever the scan holds, this returns; see Status.
  ScanReport process(const Scan& scan);

  /// Poses of all scans but those out of order: live as they were (before any loop) and final
  /// (after all loops).
  /// @{
  const Trajectory& odometry() const { return fusion_.odometry(); }
  Trajectory trajectory() const { return fusion_.fuse(back_end_.graph().poses()); }
  /// @}

  /// Writes all that later scans depend on, so that a Slam made with the same sensor and settings
  /// that reads it goes on to the same bits; the state of a custom detector is not saved. Not after
  /// the first scan in order alone, which the second may change: false, and nothing is written.
  /// `read` throws StateError when the bytes are no such state.
  /// @{
  bool write(StateWriter& writer) const;
  void read(StateReader& reader);
  /// @}

  /// Key frames in the order of time, and the graph that has their poses and the loops.
  /// @{
  const KeyFrames& key_frames() const { return back_end_.key_frames(); }
  const PoseGraph& graph() const { return back_end_.graph(); }
  /// @}

  /// Number of maps that no loop joins: 1 unless tracking was lost. Their relative poses are
  /// unconstrained.
  int maps() const { return back_end_.fragments().maps(); }

  /// The sensor's height above the ground, m: as the sensor model says or as estimated; 0 while
  /// unknown.
  double sensor_height() const { return tracker_.calibration().height; }

  /// The sensor as its model states it, and with what the drive has shown.
  const Calibration& calibration() const { return tracker_.calibration(); }

  /// What the scans held that is no measurement of the surroundings, and whether the times of their
  /// points fit the motion.
  /// @{
  const ScanFindings& findings() const { return tracker_.findings(); }
  const SweepCheck& sweep_check() const { return tracker_.sweep_check(); }
  /// @}

  /// Turns the LiDAR's axes level: by the mounting angles of the sensor model or as estimated.
  Eigen::Matrix3d R_level_lidar() const { return R_base_lidar(tracker_.calibration().sensor); }

 private:
  BackEnd new_back_end() const;
  void replace_first(const TrackedScan& first);

  double range_noise_;
  BackEndSettings back_end_settings_;
  LoopDetector detector_;
  WorkerThreads threads_;
  std::shared_ptr<KeyFrames> key_frames_;  // written by the back end, read by the tracker
  Tracker tracker_;
  BackEnd back_end_;
  TransformFusion fusion_;
};

}  // namespace lego_loam_sc
