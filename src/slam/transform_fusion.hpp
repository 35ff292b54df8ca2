// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/trajectory.hpp"
#include "tracking/tracked_scan.hpp"

namespace lego_loam_sc {

/// Transform fusion of paper figure 4: every scan hangs on a key frame, so that each correction of
/// the key frames by the pose graph reaches all scans.
class TransformFusion {
 public:
  /// Adds the next scan, unless it is out of order.
  void add(const TrackedScan& tracked);

  /// The pose of every scan for the given poses of the key frames.
  Trajectory fuse(std::span<const Pose> T_map_key) const;

  /// The live poses, before any loop.
  const Trajectory& odometry() const { return odometry_; }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive.grown(entries_);
    archive.grown(odometry_);
  }

 private:
  struct Entry {
    std::int64_t stamp_ns;
    int key_frame;
    Pose T_key_lidar;

    template <class Archive>
    void state(Archive& archive) {
      archive(stamp_ns, key_frame, T_key_lidar);
    }
  };
  std::vector<Entry> entries_;
  Trajectory odometry_;
};

}  // namespace lego_loam_sc
