// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/setting.hpp"

namespace lego_loam_sc {

/// Paper 2.3 (3).
struct OdometrySettings {
  LEGO_LOAM_SC_SETTING(bool, two_step, true,
                       "[t_z, roll, pitch] from the ground, then [t_x, t_y, yaw] from edges; off: "
                       "one joint solve");
  LEGO_LOAM_SC_SETTING(int, polish_iterations, 2, 0, 100,
                       "joint iterations over all six unknowns after the two steps");
  LEGO_LOAM_SC_SETTING(int, associations, 10, 1, 100,
                       "times that correspondences are searched anew");
  LEGO_LOAM_SC_SETTING(int, iterations, 5, 1, 100, "Levenberg-Marquardt steps for one association");
  LEGO_LOAM_SC_SETTING(double, max_distance, 5.0, 0.1, 100.0,
                       "m; correspondences farther apart are not used");
  LEGO_LOAM_SC_SETTING(int, max_row_gap, 2, 1, 16,
                       "rows between the two points of a line or the rows of a plane");
  LEGO_LOAM_SC_SETTING(int, max_points, 100, 10, 100000,
                       "of F_e and of F_p each that are matched; of more, evenly spread ones are "
                       "taken");
  LEGO_LOAM_SC_SETTING(int, min_edges, 50, 1, 100000, "fewest edge correspondences to solve with");
  LEGO_LOAM_SC_SETTING(int, min_planars, 20, 1, 100000,
                       "fewest planar correspondences to solve with");
  LEGO_LOAM_SC_SETTING(double, min_strength, 3.0, 0.0, 1000.0,
                       "constraints that must hold each direction, else it is degenerate and keeps "
                       "the guess");
};

}  // namespace lego_loam_sc
