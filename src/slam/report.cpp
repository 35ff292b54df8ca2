// SPDX-License-Identifier: BSD-3-Clause
#include "slam/report.hpp"

#include <algorithm>
#include <utility>

namespace lego_loam_sc {

ScanReport report_of(const TrackedScan& tracked, std::vector<LoopReport> loops) {
  ScanReport report;
  report.index = tracked.index;
  report.stamp_ns = tracked.stamp_ns;
  report.stamp_jump_s = tracked.stamp_jump_s;
  report.status = tracked.status;
  report.T_odom_lidar = tracked.T_odom_lidar;

  const ScanCounts& counts = tracked.counts;
  report.points = counts.points;
  report.ground_points = counts.ground_points;
  report.segment_points = counts.segment_points;
  report.clusters = counts.clusters;
  report.edges_sharp = counts.edges_sharp;
  report.planars_flat = counts.planars_flat;
  report.edges_large = counts.edges_large;
  report.planars_large = counts.planars_large;

  report.odometry_edges = tracked.motion.edges;
  report.odometry_planars = tracked.motion.planars;
  report.odometry_iterations = tracked.motion.iterations;

  const MapMatch& match = tracked.match;
  report.mapped = tracked.mapped;
  report.map_points = match.points;
  report.map_matches = match.matches;
  report.map_iterations = match.iterations;
  report.map_rmse = match.rmse;
  report.degenerate_translations = match.localizability.degenerate_translations;
  report.degenerate_rotations = match.localizability.degenerate_rotations;
  report.least_translation_strength = match.localizability.translation[0];
  report.least_rotation_strength = match.localizability.rotation[0];
  report.elevation_bias_deg = tracked.elevation_bias_deg;
  report.agreeing = tracked.testimony.agreeing;
  report.contradicting = tracked.testimony.contradicting;
  report.prediction_m = tracked.prediction_m;

  report.piece = tracked.fragment;
  if (tracked.key_frame) report.key_frame = tracked.key_frame->number;
  report.corrected = std::ranges::any_of(loops, &LoopReport::added);
  report.loops = std::move(loops);
  report.milliseconds = tracked.milliseconds;
  return report;
}

}  // namespace lego_loam_sc
