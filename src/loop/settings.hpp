// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/setting.hpp"

namespace lego_loam_sc {

/// Paper equations (2) to (8).
struct ScanContextSettings {
  LEGO_LOAM_SC_SETTING(bool, enabled, true, "find loops by Scan Context");
  LEGO_LOAM_SC_SETTING(int, rings, 20, 1, 200, "N_r, equation (3)");
  LEGO_LOAM_SC_SETTING(int, sectors, 60, 1, 720, "N_s, equation (3)");
  LEGO_LOAM_SC_SETTING(double, max_radius, 80.0, 1.0, 1000.0,
                       "m; L_max, points beyond it are left out");
  LEGO_LOAM_SC_SETTING(int, candidates, 10, 1, 1000, "nearest ring keys that are compared in full");
  LEGO_LOAM_SC_SETTING(double, threshold, 0.35, 0.0, 1.0, "tau of equation (8)");
  LEGO_LOAM_SC_SETTING(double, reach, 10.0, 0.0, 10000.0,
                       "m; two visits farther apart than this, after all drift allowed for, are "
                       "not verified");
};

/// LeGO-LOAM's own detector: key frames near the current position.
struct RadiusSearchSettings {
  LEGO_LOAM_SC_SETTING(bool, enabled, true, "find loops by distance");
  LEGO_LOAM_SC_SETTING(double, radius, 10.0, 0.1, 1000.0, "m round the current position");
  LEGO_LOAM_SC_SETTING(int, candidates, 2, 1, 1000, "nearest key frames that are verified");
};

/// Paper 2.3 (6).
struct VerifierSettings {
  LEGO_LOAM_SC_SETTING(int, neighbours, 10, 0, 1000,
                       "m of the paper: key frames on each side of the match that make the local "
                       "map");
  LEGO_LOAM_SC_SETTING(int, query_neighbours, 0, 0, 1000,
                       "key frames before the query that are merged with it");
  LEGO_LOAM_SC_SETTING(double, voxel_size, 0.5, 0.05, 10.0, "m; finest voxels of the local map");
  LEGO_LOAM_SC_SETTING(int, levels, 3, 1, 6,
                       "voxel sizes from coarse to fine, each half the one before");
  LEGO_LOAM_SC_SETTING(int, iterations, 12, 1, 1000, "ICP iterations at each level");
  LEGO_LOAM_SC_SETTING(double, planarity, 0.1, 0.0, 1.0,
                       "largest ratio of the two smaller (plane) or larger (line) eigenvalues of a "
                       "surface");
  LEGO_LOAM_SC_SETTING(int, min_matches, 50, 6, 100000, "fewest points that must find a surface");
  LEGO_LOAM_SC_SETTING(double, min_strength, 5.0, 0.0, 1000.0,
                       "constraints that must hold each direction, else the loop is degenerate");
  LEGO_LOAM_SC_SETTING(double, max_rmse, 0.2, 0.0, 10.0,
                       "m; ICP score: the residual of the inliers");
  LEGO_LOAM_SC_SETTING(double, min_overlap, 0.5, 0.0, 1.0,
                       "smallest share of the query's points that lie on a surface of the local "
                       "map");
  LEGO_LOAM_SC_SETTING(double, min_join_overlap, 0.75, 0.0, 1.0,
                       "the same for a loop that joins two maps: no pose graph can contradict it");
  LEGO_LOAM_SC_SETTING(double, max_height_difference, 2.0, 0.0, 1000.0,
                       "m between the two visits, in the frame of the match");
  LEGO_LOAM_SC_SETTING(double, max_tilt_deg, 8.0, 0.0, 180.0,
                       "deg of roll and pitch between the visits");
  LEGO_LOAM_SC_SETTING(double, consistency_sigmas, 4.0, 0.0, 1000.0,
                       "largest Mahalanobis distance from the pose graph's own estimate; 0 = no "
                       "check");
  LEGO_LOAM_SC_SETTING(double, drift_per_metre, 0.005, 0.0, 1.0,
                       "m; odometry drift that the check allows for, one sigma");
  LEGO_LOAM_SC_SETTING(double, drift_deg_per_metre, 0.01, 0.0, 10.0, "deg; the same for rotation");
};

/// Paper 2.3 (5): where loops are sought.
struct LoopSettings {
  LEGO_LOAM_SC_SETTING(double, min_travel, 30.0, 0.0, 10000.0,
                       "m travelled between two visits; less is no loop");
  LEGO_LOAM_SC_SETTING(double, min_seconds, 0.0, 0.0, 10000.0,
                       "s between two visits; less is no loop");
  LEGO_LOAM_SC_SETTING(double, spacing, 3.0, 0.0, 1000.0,
                       "m to travel after a loop, or candidates that ICP refused, before the next "
                       "is sought; longer while loops tell nothing new");
  LEGO_LOAM_SC_SETTING(int, join_candidates, 3, 1, 1000,
                       "candidates that are verified when they would join two maps");
  LEGO_LOAM_SC_SETTING(double, contradiction_sigmas, 7.0, 0.1, 1000.0,
                       "largest Mahalanobis distance of a new loop from the optimised graph; with "
                       "more it is taken out again");
  ScanContextSettings scan_context;
  RadiusSearchSettings radius_search;
  VerifierSettings verifier;
};

}  // namespace lego_loam_sc
