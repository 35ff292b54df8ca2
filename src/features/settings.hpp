// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

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
  int scattered = 100000;
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
    visit("scattered", s.scattered, 0, 1000000,
          "rough points above the ground that are kept beside the edges; of more, evenly spread ones; "
          "0 = none");
    visit("planar_spacing", s.planar_spacing, 0.0, 10.0,
          "m; distance along a row between points of the large planar set, and between scattered points");
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

}  // namespace lego_loam_sc
