// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "features/features.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "tracking/scan_check.hpp"
#include "tracking/settings.hpp"
#include "tracking/stage_timer.hpp"

namespace lego_loam_sc {

/// How the sensor is mounted, as far as it is known; angles as in SensorModel.
struct Mounting {
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double height = 0.0;  ///< m above the ground, 0 = unknown
};

/// The sensor with the angles of a mounting. Its height stays as the model states it.
SensorModel mounted(SensorModel sensor, const Mounting& mounting);

/// What a scan shows without any other, paper 2.3 (1) and (2).
struct FrontEnd {
  RangeImage image;
  Segmentation segmentation;
  Features features;
  Mounting mounting;                           ///< as given, with what was estimated
  std::array<double, kStages> milliseconds{};  ///< wall time by stage
};

/// Projects and segments a scan and extracts its features. Estimates what is not known of the
/// mounting: with `find_tilt` the tilt, when `sensor` states none, and with `height` 0 the height
/// of the sensor above the ground (m), which stays 0 when no ground is seen. `check` knows the
/// scans before.
FrontEnd run_front_end(const Scan& scan, const SensorModel& sensor, double height,
                       const FrontEndSettings& settings, bool find_tilt, ScanCheck& check);

/// The same for a scan alone.
FrontEnd run_front_end(const Scan& scan, const SensorModel& sensor, double height,
                       const FrontEndSettings& settings, bool find_tilt);

}  // namespace lego_loam_sc
