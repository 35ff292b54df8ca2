// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

/// Paper equations (2) to (8).
struct ScanContextSettings {
  bool enabled = true;
  int rings = 20;
  int sectors = 60;
  double max_radius = 80.0;
  int candidates = 10;
  double threshold = 0.35;
  double reach = 10.0;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("enabled", s.enabled, "find loops by Scan Context");
    visit("rings", s.rings, 1, 200, "N_r, equation (3)");
    visit("sectors", s.sectors, 1, 720, "N_s, equation (3)");
    visit("max_radius", s.max_radius, 1.0, 1000.0, "m; L_max, points beyond it are left out");
    visit("candidates", s.candidates, 1, 1000, "nearest ring keys that are compared in full");
    visit("threshold", s.threshold, 0.0, 1.0, "tau of equation (8)");
    visit("reach", s.reach, 0.0, 10000.0,
          "m; two visits farther apart than this, after all drift allowed for, are not verified");
  }
};

/// LeGO-LOAM's own detector: key frames near the current position.
struct RadiusSearchSettings {
  bool enabled = true;
  double radius = 10.0;
  int candidates = 2;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("enabled", s.enabled, "find loops by distance");
    visit("radius", s.radius, 0.1, 1000.0, "m round the current position");
    visit("candidates", s.candidates, 1, 1000, "nearest key frames that are verified");
  }
};

/// Paper 2.3 (6).
struct VerifierSettings {
  int neighbours = 10;
  int query_neighbours = 0;
  double voxel_size = 0.5;
  int levels = 3;
  int iterations = 12;
  double max_rmse = 0.2;
  double min_overlap = 0.5;
  double max_height_difference = 2.0;
  double max_tilt_deg = 8.0;
  double consistency_sigmas = 4.0;
  double drift_per_metre = 0.005;
  double drift_deg_per_metre = 0.01;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("neighbours", s.neighbours, 0, 1000,
          "m of the paper: key frames on each side of the match that make the local map");
    visit("query_neighbours", s.query_neighbours, 0, 1000,
          "key frames before the query that are merged with it");
    visit("voxel_size", s.voxel_size, 0.05, 10.0, "m; finest voxels of the local map");
    visit("levels", s.levels, 1, 6, "voxel sizes from coarse to fine, each half the one before");
    visit("iterations", s.iterations, 1, 1000, "ICP iterations at each level");
    visit("max_rmse", s.max_rmse, 0.0, 10.0, "m; ICP score: the residual of the inliers");
    visit("min_overlap", s.min_overlap, 0.0, 1.0,
          "smallest share of the query's points that lie on a surface of the local map");
    visit("max_height_difference", s.max_height_difference, 0.0, 1000.0,
          "m between the two visits, in the frame of the match");
    visit("max_tilt_deg", s.max_tilt_deg, 0.0, 180.0, "deg of roll and pitch between the visits");
    visit("consistency_sigmas", s.consistency_sigmas, 0.0, 1000.0,
          "largest Mahalanobis distance from the pose graph's own estimate; 0 = no check");
    visit("drift_per_metre", s.drift_per_metre, 0.0, 1.0,
          "m; odometry drift that the check allows for, one sigma");
    visit("drift_deg_per_metre", s.drift_deg_per_metre, 0.0, 10.0, "deg; the same for rotation");
  }
};

/// Paper 2.3 (5): where loops are sought.
struct LoopSettings {
  double min_travel = 30.0;
  double min_seconds = 0.0;
  double spacing = 3.0;
  ScanContextSettings scan_context;
  RadiusSearchSettings radius_search;
  VerifierSettings verifier;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("min_travel", s.min_travel, 0.0, 10000.0,
          "m travelled between two visits; less is no loop");
    visit("min_seconds", s.min_seconds, 0.0, 10000.0, "s between two visits; less is no loop");
    visit("spacing", s.spacing, 0.0, 1000.0,
          "m to travel after a loop, or candidates that ICP refused, before the next is sought; "
          "longer while loops tell nothing new");
  }
};

}  // namespace lego_loam_sc
