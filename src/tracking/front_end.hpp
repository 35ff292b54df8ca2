// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "features/features.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "slam/settings.hpp"
#include "tracking/stage_timer.hpp"

namespace lego_loam_sc {

/// What can be said of a scan without any other, paper 2.3 (1) and (2).
struct FrontEnd {
  RangeImage image;
  Segmentation segmentation;
  Features features;
  std::array<double, kStages> milliseconds{};  ///< wall time by stage
};

/// Projects and segments a scan and extracts its features. Estimates what is not known of the
/// mounting: with `find_tilt` the tilt that `sensor` does not state, which is set there, and with
/// `height` 0 that of the sensor above the ground (m), which stays 0 when no ground is seen.
FrontEnd run_front_end(const Scan& scan, SensorModel& sensor, double& height,
                       const Settings& settings, bool find_tilt);

}  // namespace lego_loam_sc
