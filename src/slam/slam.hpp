// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "core/state_archive.hpp"
#include "core/trajectory.hpp"
#include "graph/pose_graph.hpp"
#include "key_frames/key_frame.hpp"
#include "loop/loop_detector.hpp"
#include "slam/report.hpp"
#include "slam/settings.hpp"

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
  /// none. Throws std::invalid_argument when the sensor or a setting is not
  /// valid.
  Slam(const SensorModel& sensor, const Settings& settings, int threads = 1,
       LoopDetector detector = {}, std::shared_ptr<BlobStore> points = {});
  ~Slam();
  Slam(Slam&&) noexcept;
  Slam& operator=(Slam&&) noexcept;

  /// Processes the next scan. Whatever the scan holds, this returns; see Status.
  ScanReport process(const Scan& scan);

  /// Poses of all scans but those out of order: live as they were (before any loop) and final
  /// (after all loops).
  /// @{
  const Trajectory& odometry() const;
  Trajectory trajectory() const;
  /// @}

  /// Writes all that later scans depend on, so that a Slam made with the same sensor and settings
  /// that reads it goes on to the same bits; a detector of the user's own has to look after itself.
  /// Not after the first scan in order alone, which the second may change: false, and nothing is
  /// written. `read` throws StateError when the bytes are no such state.
  /// @{
  bool write(StateWriter& writer) const;
  void read(StateReader& reader);
  /// @}

  const KeyFrames& key_frames() const;  ///< in the order of time
  const PoseGraph& graph() const;       ///< has the poses of the key frames and the loops

  /// Number of maps that no loop joins: 1 unless the way was lost. Where they lie to each other is
  /// a guess.
  int maps() const;

  /// The sensor's height above the ground, m: as the sensor model says or as estimated; 0 while
  /// unknown.
  double sensor_height() const;

  /// Turns the LiDAR's axes level: by the mounting angles of the sensor model or as estimated.
  Eigen::Matrix3d R_level_lidar() const;

 private:
  struct State;
  ScanReport begin_again(const Scan& first, const Scan& second, ScanReport report);

  std::unique_ptr<State> state_;
};

}  // namespace lego_loam_sc
