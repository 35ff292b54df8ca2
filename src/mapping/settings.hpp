// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

/// Paper 2.3 (4).
struct MappingSettings {
  int every = 1;
  double voxel_size = 0.25;
  int levels = 3;
  double radius = 100.0;
  double insert_distance = 0.05;
  double match_spacing = 1.0;
  int match_points = 1000;
  int associations = 5;
  int iterations = 2;
  double max_distance = 1.5;
  double planarity = 0.1;
  double prior_translation = 0.2;
  double prior_rotation_deg = 1.0;
  double acceleration = 3.0;
  double angular_acceleration_deg = 100.0;
  int min_matches = 50;
  double min_matched_share = 0.3;
  double min_strength = 3.0;
  bool elevation_bias = true;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("every", s.every, 1, 100, "scans; every n-th is matched against the map");
    visit("voxel_size", s.voxel_size, 0.05, 10.0,
          "m; finest voxels of the map; a surface is fitted to each block of "
          "2 x 2 x 2");
    visit("levels", s.levels, 1, 4, "voxel sizes, each twice the one before");
    visit("radius", s.radius, 5.0, 1000.0, "m; the local map reaches this far round the sensor");
    visit("insert_distance", s.insert_distance, 0.0, 100.0,
          "m travelled since the last scan that went into the map");
    visit("match_spacing", s.match_spacing, 0.0, 10.0,
          "m; voxel of the filter over the points that are matched");
    visit("match_points", s.match_points, 0, 100000,
          "in small spaces that voxel shrinks until about this many points are left; 0 = never");
    visit("associations", s.associations, 1, 100, "times that correspondences are searched anew");
    visit("iterations", s.iterations, 1, 100, "Levenberg-Marquardt steps for one association");
    visit("max_distance", s.max_distance, 0.05, 100.0,
          "m; a point farther from its surface is not used");
    visit("planarity", s.planarity, 0.0, 1.0,
          "largest ratio of the two smaller (plane) or larger (line) eigenvalues of a surface");
    visit("prior_translation", s.prior_translation, 1e-3, 100.0,
          "m; one sigma of the odometry's guess, which holds the directions that the map does not");
    visit("prior_rotation_deg", s.prior_rotation_deg, 1e-3, 180.0, "deg; the same for rotation");
    visit("acceleration", s.acceleration, 0.0, 1000.0,
          "m/s^2; one sigma of what makes the velocity in a sweep differ from the motion since the "
          "last one; 0 = nothing");
    visit("angular_acceleration_deg", s.angular_acceleration_deg, 0.0, 10000.0,
          "deg/s^2; the same for rotation");
    visit("min_matches", s.min_matches, 6, 100000, "fewest matched points of a good match");
    visit("min_matched_share", s.min_matched_share, 0.0, 1.0,
          "smallest share of the points that must find a surface");
    visit("min_strength", s.min_strength, 0.0, 1000.0,
          "constraints that must hold each direction, else it is degenerate and keeps the guess");
    visit("elevation_bias", s.elevation_bias,
          "correct an error that the elevation angles of all beams have in common once the ground "
          "of the drive has proved it");
  }
};

}  // namespace lego_loam_sc
