// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

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

}  // namespace lego_loam_sc
