// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// Settings of all stages of the tracker, paper 2.3 (1) to (4).
struct TrackerSettings : FrontEndSettings {
  OdometrySettings odometry;
  MappingSettings mapping;
  KeyFrameSettings key_frames;
};

}  // namespace lego_loam_sc
