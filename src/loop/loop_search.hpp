// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "loop/drive_view.hpp"
#include "loop/loop_candidate.hpp"
#include "loop/loop_detector.hpp"
#include "loop/scan_context_index.hpp"
#include "loop/settings.hpp"

namespace lego_loam_sc {

/// Number of key frames of earlier visits: those before it lie far enough back, along the path and
/// in time, or belong to another fragment.
int count_eligible(const DriveView& drive, const LoopSettings& settings);

/// Finds loop candidates, paper 2.3 (5): by Scan Context, by distance and by a custom detector,
/// independently of each other.
class LoopSearch {
 public:
  /// `detector` may be empty.
  LoopSearch(const LoopSettings& settings, LoopDetector detector);

  /// Candidates for the newest key frame, which `context` describes, among the first `eligible`.
  std::vector<LoopCandidate> candidates(const DriveView& drive, int eligible,
                                        const ScanContext& context) const;

  /// Whether another visit has been at the place of the newest key frame, within 2 m.
  bool has_place(const DriveView& drive, int eligible) const;

  /// Makes the newest key frame stand for its place.
  void add_place(const DriveView& drive, ScanContext context);

  /// Key frames that stand for their places, in ascending order.
  std::span<const int> places() const { return contexts_.key_frames(); }

  /// After the graph has been optimised.
  void update_positions(const PoseGraph& graph);

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(contexts_, positions_);
  }

 private:
  std::vector<LoopCandidate> by_scan_context(const DriveView& drive, int eligible,
                                             const ScanContext& context) const;
  std::vector<LoopCandidate> by_distance(const DriveView& drive, int eligible,
                                         const RadiusSearchSettings& settings) const;
  std::vector<LoopCandidate> by_detector(const DriveView& drive, int eligible) const;

  LoopSettings settings_;
  LoopDetector detector_;
  ScanContextIndex contexts_;
  std::vector<Eigen::Vector3d> positions_;  // of the places, map frame; in cache, unlike all poses
};

}  // namespace lego_loam_sc
