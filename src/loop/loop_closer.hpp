// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "graph/map_fragments.hpp"
#include "graph/pose_graph.hpp"
#include "graph/settings.hpp"
#include "key_frames/key_frames.hpp"
#include "loop/drive_view.hpp"
#include "loop/loop_detector.hpp"
#include "loop/loop_insertion.hpp"
#include "loop/loop_report.hpp"
#include "loop/loop_search.hpp"
#include "loop/search_pacing.hpp"
#include "loop/settings.hpp"

namespace lego_loam_sc {

/// Loop closing, paper 2.3 (5) and (6): searches for candidates, verifies them by ICP and inserts
/// what is accepted into the pose graph.
class LoopCloser {
 public:
  /// `range_noise` in m, one sigma.
  LoopCloser(const LoopSettings& settings, const GraphSettings& graph, double range_noise,
             LoopDetector detector = {});

  /// Looks for loops that end at the newest key frame, which `context` describes, and adds at most
  /// one to the graph, which may join fragments. Call once for each key frame. Returns every
  /// candidate that was verified.
  std::vector<LoopReport> close(const KeyFrames& key_frames, ScanContext context,
                                MapFragments& fragments, PoseGraph& graph);

  /// The key frames that stand for their places, in ascending order; all but those of known places.
  std::span<const int> places() const { return search_.places(); }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(search_, pacing_, insertion_);
  }

 private:
  enum class Outcome { refused, redundant, added };

  std::vector<LoopReport> try_candidates(const std::vector<LoopCandidate>& candidates,
                                         const DriveView& drive, MapFragments& fragments,
                                         PoseGraph& graph);
  Outcome judge(LoopReport& report, const DriveView& drive, MapFragments& fragments,
                PoseGraph& graph);
  PoseEdge edge_of(const LoopReport& report) const;
  bool is_known_place(const DriveView& drive, int eligible) const;

  LoopSettings settings_;
  GraphSettings graph_settings_;
  double range_noise_;
  LoopSearch search_;
  SearchPacing pacing_;
  LoopInsertion insertion_;
};

}  // namespace lego_loam_sc
