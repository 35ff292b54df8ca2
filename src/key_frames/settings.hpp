// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

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
