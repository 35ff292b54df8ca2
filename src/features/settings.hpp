// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/setting.hpp"

namespace lego_loam_sc {

/// Paper equation (1) and 2.3 (2).
struct FeatureSettings {
  LEGO_LOAM_SC_SETTING(int, sub_images, 6, 1, 64, "equal parts of a row; features come from each");
  LEGO_LOAM_SC_SETTING(int, neighbours, 5, 1, 20, "points on each side that make the set S");
  LEGO_LOAM_SC_SETTING(double, roughness_threshold, 0.004, 0.0, 1.0,
                       "c_th: rougher points, equation (1), are edges, smoother ones planar");
  LEGO_LOAM_SC_SETTING(double, noise_factor, 2.0, 0.0, 100.0,
                       "sigmas; c_th is at least the roughness that this much range noise makes");
  LEGO_LOAM_SC_SETTING(int, edges_sharp, 2, 0, 1000, "sharpest edges per row and sub-image, F_e");
  LEGO_LOAM_SC_SETTING(int, edges_large, 20, 0, 1000, "edges per row and sub-image, large set F_e");
  LEGO_LOAM_SC_SETTING(int, planars_flat, 4, 0, 1000, "flattest points per row and sub-image, F_p");
  LEGO_LOAM_SC_SETTING(int, planars_large, 0, 0, 10000,
                       "planar points per row and sub-image, large set F_p; 0 = all that "
                       "planar_spacing leaves");
  LEGO_LOAM_SC_SETTING(bool, flat_from_ground_only, true, "F_p is taken from the ground alone");
  LEGO_LOAM_SC_SETTING(int, min_ground_flats, 100, 0, 100000,
                       "with fewer points of F_p on the ground, it is taken from everywhere after "
                       "all");
  LEGO_LOAM_SC_SETTING(int, scattered, 100000, 0, 1000000,
                       "rough points above the ground that are kept beside the edges; of more, "
                       "evenly spread ones; 0 = none");
  LEGO_LOAM_SC_SETTING(
      double, planar_spacing, 0.2, 0.0, 10.0,
      "m; distance along a row between points of the large planar set, and between "
      "scattered points");
  LEGO_LOAM_SC_SETTING(int, suppressed_neighbours, 5, 0, 20,
                       "points on each side of a pick that cannot be picked any more");
  LEGO_LOAM_SC_SETTING(int, max_column_gap, 2, 1, 100,
                       "usual steps along a row; points farther apart are no neighbours");
  LEGO_LOAM_SC_SETTING(int, max_ground_gap, 10, 1, 100,
                       "usual steps along a row; the same for two points of the ground");
  LEGO_LOAM_SC_SETTING(double, occlusion_gap, 0.3, 0.0, 10.0,
                       "m; the far side of a range jump larger than this makes no features");
};

}  // namespace lego_loam_sc
