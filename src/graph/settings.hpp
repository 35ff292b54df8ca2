// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/setting.hpp"

namespace lego_loam_sc {

/// Paper 2.3 (4) and (6): GTSAM.
struct GraphSettings {
  LEGO_LOAM_SC_SETTING(double, odometry_sigma, 0.01, 1e-6, 100.0,
                       "m; smallest sigma of the edge between two key frames");
  LEGO_LOAM_SC_SETTING(double, odometry_sigma_deg, 0.05, 1e-6, 180.0, "deg; the same for rotation");
  LEGO_LOAM_SC_SETTING(double, degenerate_inflation, 10.0, 1.0, 1e6,
                       "factor on the sigma of a degenerate direction");
  LEGO_LOAM_SC_SETTING(double, loop_sigma, 0.05, 1e-6, 100.0, "m; smallest sigma of a loop edge");
  LEGO_LOAM_SC_SETTING(double, loop_sigma_deg, 0.2, 1e-6, 180.0, "deg; the same for rotation");
  LEGO_LOAM_SC_SETTING(double, loop_kernel, 3.0, 0.0, 1e6,
                       "sigmas; Huber kernel on loop edges, widened by what drift explains; 0 = no "
                       "kernel");
  LEGO_LOAM_SC_SETTING(double, precision, 0.001, 1e-6, 0.1,
                       "m and rad; what moves by less is not linearised anew when a loop comes");
};

}  // namespace lego_loam_sc
