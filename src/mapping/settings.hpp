// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/setting.hpp"

namespace lego_loam_sc {

/// Paper 2.3 (4).
struct MappingSettings {
  LEGO_LOAM_SC_SETTING(int, every, 1, 1, 100, "scans; every n-th is matched against the map");
  LEGO_LOAM_SC_SETTING(double, voxel_size, 0.25, 0.05, 10.0,
                       "m; finest voxels of the map; a surface is fitted to each block of 2 x 2 x "
                       "2");
  LEGO_LOAM_SC_SETTING(int, levels, 3, 1, 4, "voxel sizes, each twice the one before");
  LEGO_LOAM_SC_SETTING(double, radius, 100.0, 5.0, 1000.0,
                       "m; the local map reaches this far round the sensor");
  LEGO_LOAM_SC_SETTING(double, insert_distance, 0.05, 0.0, 100.0,
                       "m travelled since the last scan that went into the map");
  LEGO_LOAM_SC_SETTING(double, match_spacing, 1.0, 0.0, 10.0,
                       "m; voxel of the filter over the points that are matched");
  LEGO_LOAM_SC_SETTING(int, match_points, 1000, 0, 100000,
                       "in small spaces that voxel shrinks until about this many points are left; "
                       "0 = never");
  LEGO_LOAM_SC_SETTING(int, scattered_points, 600, 0, 100000,
                       "scattered points that are matched; of more, evenly spread ones are taken");
  LEGO_LOAM_SC_SETTING(int, associations, 20, 1, 100,
                       "times that correspondences are searched anew");
  LEGO_LOAM_SC_SETTING(int, iterations, 2, 1, 100, "Levenberg-Marquardt steps for one association");
  LEGO_LOAM_SC_SETTING(double, max_distance, 1.5, 0.05, 100.0,
                       "m; a point farther from its surface is not used");
  LEGO_LOAM_SC_SETTING(double, planarity, 0.1, 0.0, 1.0,
                       "largest ratio of the two smaller (plane) or larger (line) eigenvalues of a "
                       "surface");
  LEGO_LOAM_SC_SETTING(double, prior_translation, 0.2, 1e-3, 100.0,
                       "m; one sigma of the odometry's guess, which holds the directions that the "
                       "map does not");
  LEGO_LOAM_SC_SETTING(double, prior_rotation_deg, 1.0, 1e-3, 180.0, "deg; the same for rotation");
  LEGO_LOAM_SC_SETTING(double, acceleration, 3.0, 0.0, 1000.0,
                       "m/s^2; one sigma of what makes the velocity in a sweep differ from the "
                       "motion since the last one; 0 = nothing");
  LEGO_LOAM_SC_SETTING(double, angular_acceleration_deg, 100.0, 0.0, 10000.0,
                       "deg/s^2; the same for rotation");
  LEGO_LOAM_SC_SETTING(int, min_matches, 50, 6, 100000, "fewest matched points of a good match");
  LEGO_LOAM_SC_SETTING(double, min_matched_share, 0.3, 0.0, 1.0,
                       "smallest share of the points that must find a surface");
  LEGO_LOAM_SC_SETTING(double, min_significance, 4.0, 0.0, 1000.0,
                       "sigmas; a direction in which the scan fits the map less clearly is "
                       "degenerate and keeps the prediction");
  LEGO_LOAM_SC_SETTING(
      bool, elevation_bias, true,
      "correct an error that the elevation angles of all beams have in common once "
      "the ground of the drive has proved it");
};

}  // namespace lego_loam_sc
