// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/setting.hpp"

namespace lego_loam_sc {

/// When a scan becomes a key frame, and how much of it is kept.
struct KeyFrameSettings {
  LEGO_LOAM_SC_SETTING(double, distance, 2.0, 0.01, 1000.0, "m travelled since the last key frame");
  LEGO_LOAM_SC_SETTING(double, rotation_deg, 10.0, 0.1, 360.0,
                       "deg turned since the last key frame");
  LEGO_LOAM_SC_SETTING(double, point_spacing, 0.3, 0.02, 10.0,
                       "m; voxel of the filter over the points that a key frame keeps for the map");
};

}  // namespace lego_loam_sc
