// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "graph/map_fragments.hpp"
#include "graph/pose_graph.hpp"
#include "key_frames/correction.hpp"
#include "key_frames/key_frames.hpp"
#include "key_frames/tracked_key_frame.hpp"
#include "loop/loop_closer.hpp"
#include "loop/loop_detector.hpp"
#include "loop/loop_report.hpp"
#include "slam/settings.hpp"

namespace lego_loam_sc {

/// Global SLAM, paper 2.3 (5) and (6): keeps the key frames and the pose graph, finds loops and
/// spreads their correction. Takes key frames and never sees a scan or the local map.
class BackEnd {
 public:
  /// `range_noise` in m, one sigma. `key_frames` is emptied and takes those that are added.
  BackEnd(const BackEndSettings& settings, double range_noise, LoopDetector detector,
          std::shared_ptr<KeyFrames> key_frames);

  /// What came of a key frame.
  struct Result {
    std::vector<LoopReport> loops;         ///< every candidate that was verified
    std::optional<Correction> correction;  ///< when there is news for the tracker
  };

  /// The next key frame.
  Result add(const TrackedKeyFrame& key_frame);

  const KeyFrames& key_frames() const { return *key_frames_; }  ///< in the order of time
  /// Key frames, odometry and loops.
  const PoseGraph& graph() const { return graph_; }
  /// What belongs together.
  const MapFragments& fragments() const { return fragments_; }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(loop_closer_, graph_, fragments_, *key_frames_);
    archive.grown(scan_of_key_frame_);
  }

 private:
  void add_to_graph(const TrackedKeyFrame& key_frame);
  std::optional<Correction> correction_after(const std::vector<LoopReport>& loops) const;

  BackEndSettings settings_;
  std::shared_ptr<KeyFrames> key_frames_;
  PoseGraph graph_;
  MapFragments fragments_;
  LoopCloser loop_closer_;
  std::vector<int> scan_of_key_frame_;
};

}  // namespace lego_loam_sc
