// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/front_end.hpp"

#include "segmentation/ground.hpp"
#include "segmentation/mounting.hpp"

namespace lego_loam_sc {

SensorModel mounted(SensorModel sensor, const Mounting& mounting) {
  sensor.mount_roll_deg = mounting.roll_deg;
  sensor.mount_pitch_deg = mounting.pitch_deg;
  return sensor;
}

FrontEnd run_front_end(const Scan& scan, const SensorModel& sensor, double height,
                       const FrontEndSettings& settings, bool find_tilt, ScanCheck& check) {
  FrontEnd result;
  StageTimer timer(result.milliseconds);
  timer.start(Stage::projection);
  SensorModel levelled = sensor;
  result.image = project(scan, levelled);
  check.check(result.image);
  if (find_tilt && estimate_tilt(result.image, levelled)) {
    result.image = project(scan, levelled);
    check.correct(result.image);
  }
  if (height == 0.0)
    height = estimate_sensor_height(result.image, levelled, settings.segmentation).value_or(0.0);
  result.mounting = {levelled.mount_roll_deg, levelled.mount_pitch_deg, height};

  timer.start(Stage::segmentation);
  result.segmentation = segment(result.image, levelled, height, settings.segmentation);

  timer.start(Stage::features);
  result.features =
      extract_features(result.image, result.segmentation, levelled, settings.features);
  timer.stop();
  return result;
}

FrontEnd run_front_end(const Scan& scan, const SensorModel& sensor, double height,
                       const FrontEndSettings& settings, bool find_tilt) {
  ScanCheck check(sensor);
  return run_front_end(scan, sensor, height, settings, find_tilt, check);
}

}  // namespace lego_loam_sc
