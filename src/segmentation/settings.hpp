// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/setting.hpp"

namespace lego_loam_sc {

/// Paper 2.1 and 2.3 (1).
struct SegmentationSettings {
  LEGO_LOAM_SC_SETTING(bool, enabled, true,
                       "off: no ground, no clusters, every point is kept (LOAM)");
  LEGO_LOAM_SC_SETTING(double, ground_slope_deg, 10.0, 0.0, 45.0,
                       "deg; steepest slope between two rows of the ground");
  LEGO_LOAM_SC_SETTING(double, ground_max_elevation_deg, 0.0, -90.0, 90.0,
                       "deg; only beams below this elevation can see the ground");
  LEGO_LOAM_SC_SETTING(double, ground_height_tolerance, 0.4, 0.0, 10.0,
                       "m; a ground point lies at most this far above or below the last one, plus "
                       "5 % of the way");
  LEGO_LOAM_SC_SETTING(int, ground_max_row_gap, 3, 1, 16,
                       "rows; how far apart two neighbours on the ground may be");
  LEGO_LOAM_SC_SETTING(double, cluster_angle_deg, 60.0, 1.0, 89.0,
                       "deg; neighbours are one object when the angle beta between them exceeds "
                       "this");
  LEGO_LOAM_SC_SETTING(int, cluster_min_points, 30, 1, 100000,
                       "points; smaller clusters are dropped as noise");
  LEGO_LOAM_SC_SETTING(int, thin_cluster_min_points, 5, 1, 100000,
                       "points; a cluster this large is kept when it spans thin_cluster_min_rows "
                       "(poles)");
  LEGO_LOAM_SC_SETTING(int, thin_cluster_min_rows, 3, 1, 128, "rows; see above");
};

}  // namespace lego_loam_sc
