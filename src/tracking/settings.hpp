// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/setting.hpp"
#include "features/settings.hpp"
#include "key_frames/settings.hpp"
#include "mapping/settings.hpp"
#include "odometry/settings.hpp"
#include "segmentation/settings.hpp"

namespace lego_loam_sc {

/// Settings of paper 2.3 (1) and (2).
struct FrontEndSettings {
  SegmentationSettings segmentation;
  FeatureSettings features;
};

/// When a scan has no place of its own, and when tracking begins anew.
struct TrackingSettings {
  LEGO_LOAM_SC_SETTING(int, min_points, 100, 10, 1000000,
                       "points; the pose of a scan of fewer is predicted");
  LEGO_LOAM_SC_SETTING(double, max_gap, 1.0, 0.0, 3600.0,
                       "s; after a longer gap between two scans only the map tells the place");
  LEGO_LOAM_SC_SETTING(int, patience, 10, 1, 100000,
                       "scans in a row without a place before a new map begins");
};

/// Settings of all stages of the tracker, paper 2.3 (1) to (4).
struct TrackerSettings : FrontEndSettings {
  OdometrySettings odometry;
  MappingSettings mapping;
  TrackingSettings tracking;
  KeyFrameSettings key_frames;
};

}  // namespace lego_loam_sc
