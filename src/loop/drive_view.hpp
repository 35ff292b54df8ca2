// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "graph/map_fragments.hpp"
#include "graph/pose_graph.hpp"
#include "key_frames/key_frames.hpp"

namespace lego_loam_sc {

/// What is known of the drive while loops are sought that end at its newest key frame.
struct DriveView {
  const KeyFrames& key_frames;
  const MapFragments& fragments;
  const PoseGraph& graph;

  /// The last key frame.
  int newest() const { return static_cast<int>(key_frames.size()) - 1; }
  double travelled() const { return key_frames.travelled(key_frames.size() - 1); }  ///< m
  /// Whether a loop would join two maps, whose relative pose is unknown until then.
  bool joins_maps(int match) const { return !fragments.joined(match, newest()); }
};

}  // namespace lego_loam_sc
