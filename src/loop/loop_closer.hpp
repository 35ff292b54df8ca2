// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "graph/map_fragments.hpp"
#include "graph/pose_graph.hpp"
#include "graph/settings.hpp"
#include "key_frames/key_frames.hpp"
#include "loop/loop_candidate.hpp"
#include "loop/loop_detector.hpp"
#include "loop/loop_report.hpp"
#include "loop/scan_context_index.hpp"
#include "loop/settings.hpp"

namespace lego_loam_sc {

/// Loop closing, paper 2.3 (5) and (6): candidates from Scan Context, from the radius search and
/// from a detector of the user's own, independently, verified by ICP and checked against the pose
/// graph.
class LoopCloser {
 public:
  LoopCloser(const LoopSettings& settings, const GraphSettings& graph, double range_noise,
             LoopDetector detector = {});

  /// Looks for loops that end at the newest key frame, which `context` describes, and adds accepted
  /// ones to the graph, which may join pieces. The graph is optimised, and a loop that the others
  /// contradict is taken out again; in a graph of many loops one that agrees waits for a few more.
  /// Call once for each key frame. Returns every candidate that was verified.
  std::vector<LoopReport> close(const KeyFrames& key_frames, ScanContext context, MapFragments& pieces,
                                PoseGraph& graph);

  /// The key frames that stand for their places, in ascending order; all but those of known places.
  std::span<const int> places() const { return contexts_.key_frames(); }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(contexts_, positions_, last_loop_travelled_, next_search_travelled_, pause_, waiting_);
  }

 private:
  int count_eligible(const KeyFrames& key_frames, const MapFragments& pieces) const;
  std::vector<LoopReport> find(const KeyFrames& key_frames, int eligible,
                               const ScanContext& context, MapFragments& pieces, PoseGraph& graph);
  std::vector<LoopCandidate> candidates(const KeyFrames& key_frames, int eligible,
                                        const ScanContext& context, const MapFragments& pieces,
                                        const PoseGraph& graph) const;
  enum class Effort { glance, full };
  LoopVerification verify(const LoopCandidate& candidate, Effort effort,
                          const KeyFrames& key_frames, const MapFragments& pieces,
                          const PoseGraph& graph) const;

  // What came of a candidate.
  enum class Outcome { refused, nothing_new, added };
  Outcome judge(LoopReport& report, const KeyFrames& key_frames, MapFragments& pieces, PoseGraph& graph);
  double longer_pause(int match, const PoseGraph& graph) const;

  std::vector<LoopCandidate> near_newest(int eligible, const PoseGraph& graph,
                                         const RadiusSearchSettings& settings) const;
  bool place_is_known(double travelled, int eligible, const PoseGraph& graph) const;
  PoseEdge edge_of(const LoopReport& report) const;
  bool tells_nothing_new(const PoseEdge& loop, double travelled, const PoseGraph& graph) const;
  bool add_to(PoseGraph& graph, const PoseEdge& loop, bool joins);
  void optimise(PoseGraph& graph);
  void pause(double travelled, double metres);

  LoopSettings settings_;
  GraphSettings graph_settings_;
  double range_noise_;
  LoopDetector detector_;
  ScanContextIndex contexts_;
  std::vector<Eigen::Vector3d> positions_;  // of the places, map frame; in cache, unlike all poses
  double last_loop_travelled_ = -1e9;       // m along the path
  double next_search_travelled_ = 0.0;
  double pause_;     // m
  int waiting_ = 0;  // loops in the graph that it was not optimised for
};

}  // namespace lego_loam_sc
