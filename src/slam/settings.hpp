// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/setting.hpp"
#include "graph/settings.hpp"
#include "loop/settings.hpp"
#include "tracking/settings.hpp"

namespace lego_loam_sc {

// Plain data: each stage declares its settings in a struct of its own, see core/setting.hpp, and
// loading, printing, validation and the bindings visit them there. The defaults are the method
// `lego-loam-sc`; config/methods/*.yaml hold the other methods as differences from it.

/// What a run writes.
struct OutputSettings {
  LEGO_LOAM_SC_SETTING(double, map_voxel_size, 0.1, 0.01, 10.0,
                       "m; voxel of the filter over the map");
};

/// From where on what an operator watches is a warning and an error, see slam/health.hpp. The
/// defaults hold for every sensor and place.
struct HealthSettings {
  // Under an open sky it is near one half, and two thirds of the sky side of a covered lens leave a
  // tenth.
  LEGO_LOAM_SC_SETTING(double, points_warning, 0.1, 0.0, 1.0,
                       "share of the sensor's beams that bring a point, at least");
  LEGO_LOAM_SC_SETTING(double, points_error, 0.02, 0.0, 1.0, "the same");
  // A pose has six unknowns: a hundred features for each average the noise to a tenth, with twenty
  // single wrong ones show.
  LEGO_LOAM_SC_SETTING(double, features_warning, 600.0, 0.0, 1e6,
                       "edges and planar points, at least");
  LEGO_LOAM_SC_SETTING(double, features_error, 120.0, 0.0, 1e6, "the same");
  // At the error level, the default of mapping.min_matched_share, a match is refused.
  LEGO_LOAM_SC_SETTING(double, inliers_warning, 0.4, 0.0, 1.0,
                       "share of the matched points that lie on a surface of the map, at least");
  LEGO_LOAM_SC_SETTING(double, inliers_error, 0.3, 0.0, 1.0, "the same");
  // Surfaces are no planes and sweeps no snapshots, which costs two; at ten the points lie beside
  // the surfaces.
  LEGO_LOAM_SC_SETTING(double, residual_warning, 5.0, 0.0, 1e6,
                       "sigmas of the sensor's range from the points to their surfaces, at most");
  LEGO_LOAM_SC_SETTING(double, residual_error, 10.0, 0.0, 1e6, "sigmas; the same");
  // One direction, as along a tunnel, is carried over by the prediction, with more the pose floats.
  LEGO_LOAM_SC_SETTING(double, degeneracy_warning, 1.0, 0.0, 7.0,
                       "directions that the map does not hold; from so many on");
  LEGO_LOAM_SC_SETTING(double, degeneracy_error, 2.0, 0.0, 7.0, "directions; the same");
  // Within a turn of 0.1 s three times gravity makes 0.3 m; at 1 m the search may end in the wrong
  // place.
  LEGO_LOAM_SC_SETTING(double, prediction_warning, 0.3, 0.0, 1000.0,
                       "m between the predicted and the found position, at most");
  LEGO_LOAM_SC_SETTING(double, prediction_error, 1.0, 0.0, 1000.0, "m; the same");
  // One turn of the sensor waits, or ten do and a driver begins to drop them.
  LEGO_LOAM_SC_SETTING(double, delay_warning, 0.1, 0.0, 3600.0,
                       "s by which a live run is behind the sensor, at most");
  LEGO_LOAM_SC_SETTING(double, delay_error, 1.0, 0.0, 3600.0, "s; the same");
};

/// Settings of paper 2.3 (5) and (6).
struct BackEndSettings {
  LoopSettings loop;
  GraphSettings graph;
};

/// All settings of the SLAM; docs/settings.md explains each.
struct Settings : TrackerSettings, BackEndSettings {
  OutputSettings output;
  HealthSettings health;

  /// Calls visit(group, section) for each group of settings, in the order of the pipeline; nested
  /// groups are named with a dot.
  template <class Self, class Visit>
  static void groups(Self& s, Visit&& visit) {
    visit("segmentation", s.segmentation);
    visit("features", s.features);
    visit("odometry", s.odometry);
    visit("mapping", s.mapping);
    visit("tracking", s.tracking);
    visit("key_frames", s.key_frames);
    visit("loop", s.loop);
    visit("loop.scan_context", s.loop.scan_context);
    visit("loop.radius_search", s.loop.radius_search);
    visit("loop.verifier", s.loop.verifier);
    visit("graph", s.graph);
    visit("output", s.output);
    visit("health", s.health);
  }
};

/// The first setting out of range as one sentence that names it, or nothing.
std::optional<std::string> validate(const Settings& settings);

}  // namespace lego_loam_sc
