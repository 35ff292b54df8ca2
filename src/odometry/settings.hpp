// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

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

}  // namespace lego_loam_sc
