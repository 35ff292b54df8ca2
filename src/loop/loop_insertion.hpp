// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "graph/pose_graph.hpp"

namespace lego_loam_sc {

/// Adds loops to the pose graph and takes one out again that the others contradict.
class LoopInsertion {
 public:
  /// See LoopSettings::contradiction_sigmas.
  explicit LoopInsertion(double contradiction_sigmas)
      : contradiction_sigmas_(contradiction_sigmas) {}

  /// Adds a loop and optimises, except that in a graph of many loops a consistent one waits for a
  /// few more. `joins_maps`: the graph knew nothing of their relative pose. False when the
  /// optimised graph contradicts the loop, which is then taken out again.
  bool insert(const PoseEdge& loop, bool joins_maps, PoseGraph& graph);

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(loops_since_optimisation_);
  }

 private:
  double contradiction_sigmas_;
  int loops_since_optimisation_ = 0;
};

}  // namespace lego_loam_sc
