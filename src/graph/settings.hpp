// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

/// Paper 2.3 (4) and (6): GTSAM.
struct GraphSettings {
  double odometry_sigma = 0.01;
  double odometry_sigma_deg = 0.05;
  double degenerate_inflation = 10.0;
  double loop_sigma = 0.05;
  double loop_sigma_deg = 0.2;
  double loop_kernel = 3.0;
  double precision = 0.001;

  template <class Self, class Visit>
  static void fields(Self& s, Visit&& visit) {
    visit("odometry_sigma", s.odometry_sigma, 1e-6, 100.0,
          "m; smallest sigma of the edge between two key frames");
    visit("odometry_sigma_deg", s.odometry_sigma_deg, 1e-6, 180.0, "deg; the same for rotation");
    visit("degenerate_inflation", s.degenerate_inflation, 1.0, 1e6,
          "factor on the sigma of a degenerate direction");
    visit("loop_sigma", s.loop_sigma, 1e-6, 100.0, "m; smallest sigma of a loop edge");
    visit("loop_sigma_deg", s.loop_sigma_deg, 1e-6, 180.0, "deg; the same for rotation");
    visit("loop_kernel", s.loop_kernel, 0.0, 1e6,
          "sigmas; Huber kernel on loop edges, widened by what drift explains; 0 = no kernel");
    visit("precision", s.precision, 1e-6, 0.1,
          "m and rad; what moves by less is not linearised anew when a loop comes");
  }
};

}  // namespace lego_loam_sc
