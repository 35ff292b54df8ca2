// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

// Settings from the scan to the key frame; see core/settings.hpp for how they are described.

/// Paper 2.1 and 2.3 (1).
struct SegmentationSettings {
  bool enabled = true;
  double ground_slope_deg = 10.0;
  double ground_max_elevation_deg = 0.0;
  double ground_height_tolerance = 0.4;
  int ground_max_row_gap = 3;
  double cluster_angle_deg = 60.0;
  int cluster_min_points = 30;
  int thin_cluster_min_points = 5;
  int thin_cluster_min_rows = 3;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("enabled", s.enabled, "off: no ground, no clusters, every point is kept (LOAM)");
    visit("ground_slope_deg", s.ground_slope_deg, 0.0, 45.0,
          "deg; steepest slope between two rows of the ground");
    visit("ground_max_elevation_deg", s.ground_max_elevation_deg, -90.0, 90.0,
          "deg; only beams below this elevation can see the ground");
    visit(
        "ground_height_tolerance", s.ground_height_tolerance, 0.0, 10.0,
        "m; a ground point lies at most this far above or below the last one, plus 5 % of the way");
    visit("ground_max_row_gap", s.ground_max_row_gap, 1, 16,
          "rows; how far apart two neighbours on the ground may be");
    visit("cluster_angle_deg", s.cluster_angle_deg, 1.0, 89.0,
          "deg; neighbours are one object when the angle beta between them exceeds this");
    visit("cluster_min_points", s.cluster_min_points, 1, 100000,
          "points; smaller clusters are dropped as noise");
    visit("thin_cluster_min_points", s.thin_cluster_min_points, 1, 100000,
          "points; a cluster this large is kept when it spans thin_cluster_min_rows (poles)");
    visit("thin_cluster_min_rows", s.thin_cluster_min_rows, 1, 128, "rows; see above");
  }
};

/// Paper equation (1) and 2.3 (2).
struct FeatureSettings {
  int sub_images = 6;
  int neighbours = 5;
  double roughness_threshold = 0.004;
  double noise_factor = 2.0;
  int edges_sharp = 2;
  int edges_large = 20;
  int planars_flat = 4;
  int planars_large = 0;
  bool flat_from_ground_only = true;
  int min_ground_flats = 100;
  int min_edges = 100;
  double planar_spacing = 0.2;
  int suppressed_neighbours = 5;
  int max_column_gap = 2;
  int max_ground_gap = 10;
  double occlusion_gap = 0.3;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("sub_images", s.sub_images, 1, 64, "equal parts of a row; features come from each");
    visit("neighbours", s.neighbours, 1, 20, "points on each side that make the set S");
    visit("roughness_threshold", s.roughness_threshold, 0.0, 1.0,
          "c_th: rougher points, equation (1), are edges, smoother ones planar");
    visit("noise_factor", s.noise_factor, 0.0, 100.0,
          "sigmas; c_th is at least the roughness that this much range noise makes");
    visit("edges_sharp", s.edges_sharp, 0, 1000, "sharpest edges per row and sub-image, F_e");
    visit("edges_large", s.edges_large, 0, 1000, "edges per row and sub-image, large set F_e");
    visit("planars_flat", s.planars_flat, 0, 1000, "flattest points per row and sub-image, F_p");
    visit("planars_large", s.planars_large, 0, 10000,
          "planar points per row and sub-image, large set F_p; 0 = all that planar_spacing leaves");
    visit("flat_from_ground_only", s.flat_from_ground_only, "F_p is taken from the ground alone");
    visit("min_ground_flats", s.min_ground_flats, 0, 100000,
          "with fewer points of F_p on the ground, it is taken from everywhere after all");
    visit("min_edges", s.min_edges, 0, 100000,
          "with fewer edges in a scan, all that stands on the ground is matched with the map; 0 = "
          "never");
    visit("planar_spacing", s.planar_spacing, 0.0, 10.0,
          "m; distance along a row between points of the large planar set");
    visit("suppressed_neighbours", s.suppressed_neighbours, 0, 20,
          "points on each side of a pick that cannot be picked any more");
    visit("max_column_gap", s.max_column_gap, 1, 100,
          "usual steps along a row; points farther apart are no neighbours");
    visit("max_ground_gap", s.max_ground_gap, 1, 100,
          "usual steps along a row; the same for two points of the ground");
    visit("occlusion_gap", s.occlusion_gap, 0.0, 10.0,
          "m; the far side of a range jump larger than this makes no features");
  }
};

/// Paper 2.3 (3).
struct OdometrySettings {
  bool two_step = true;
  int polish_iterations = 2;
  int associations = 10;
  int iterations = 5;
  double max_distance = 5.0;
  int max_row_gap = 2;
  int max_points = 100;
  int min_edges = 50;
  int min_planars = 20;
  double min_strength = 3.0;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("two_step", s.two_step,
          "[t_z, roll, pitch] from the ground, then [t_x, t_y, yaw] from edges; off: one joint "
          "solve");
    visit("polish_iterations", s.polish_iterations, 0, 100,
          "joint iterations over all six unknowns after the two steps");
    visit("associations", s.associations, 1, 100, "times that correspondences are searched anew");
    visit("iterations", s.iterations, 1, 100, "Levenberg-Marquardt steps for one association");
    visit("max_distance", s.max_distance, 0.1, 100.0,
          "m; correspondences farther apart are not used");
    visit("max_row_gap", s.max_row_gap, 1, 16,
          "rows between the two points of a line or the rows of a plane");
    visit("max_points", s.max_points, 10, 100000,
          "of F_e and of F_p each that are matched; of more, evenly spread ones are taken");
    visit("min_edges", s.min_edges, 1, 100000, "fewest edge correspondences to solve with");
    visit("min_planars", s.min_planars, 1, 100000, "fewest planar correspondences to solve with");
    visit("min_strength", s.min_strength, 0.0, 1000.0,
          "constraints that must hold each direction, else it is degenerate and keeps the guess");
  }
};

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
    visit(
        "elevation_bias", s.elevation_bias,
        "find and correct errors of the elevation angles on the way: of all beams and of each row");
  }
};

/// When a scan becomes a key frame, and how much of it is kept.
struct KeyFrameSettings {
  double distance = 2.0;
  double rotation_deg = 10.0;
  double point_spacing = 0.3;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("distance", s.distance, 0.01, 1000.0, "m travelled since the last key frame");
    visit("rotation_deg", s.rotation_deg, 0.1, 360.0, "deg turned since the last key frame");
    visit("point_spacing", s.point_spacing, 0.02, 10.0,
          "m; voxel of the filter over the points that a key frame keeps for the map");
  }
};

}  // namespace lego_loam_sc
