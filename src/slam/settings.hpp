// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "graph/settings.hpp"
#include "loop/settings.hpp"
#include "tracking/settings.hpp"

namespace lego_loam_sc {

// Plain data with defaults. Each struct lists its fields once more in `fields`, with the range of
// legal values and a comment; loading, printing and validation all go through that list. A
// visitor is called as visit(name, value, minimum, maximum, comment) for numbers and as
// visit(name, value, comment) for switches.
//
// The defaults are the method `lego-loam-sc`; config/methods/*.yaml hold the other methods as
// differences from it.

/// What a run writes.
struct OutputSettings {
  double map_voxel_size = 0.1;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("map_voxel_size", s.map_voxel_size, 0.01, 10.0, "m; voxel of the filter over the map");
  }
};

/// Settings of paper 2.3 (5) and (6).
struct BackEndSettings {
  LoopSettings loop;
  GraphSettings graph;
};

/// All settings of the SLAM; docs/settings.md explains each.
struct Settings : TrackerSettings, BackEndSettings {
  OutputSettings output;

  /// Calls visit(group, section) for each group of settings, in the order of the pipeline; nested
  /// groups are named with a dot.
  template <class Self, class Visit>
  static void groups(Self& s, Visit&& visit) {
    visit("segmentation", s.segmentation);
    visit("features", s.features);
    visit("odometry", s.odometry);
    visit("mapping", s.mapping);
    visit("key_frames", s.key_frames);
    visit("loop", s.loop);
    visit("loop.scan_context", s.loop.scan_context);
    visit("loop.radius_search", s.loop.radius_search);
    visit("loop.verifier", s.loop.verifier);
    visit("graph", s.graph);
    visit("output", s.output);
  }
};

/// The first setting out of range as one sentence that names it, or nothing.
std::optional<std::string> validate(const Settings& settings);

}  // namespace lego_loam_sc
