// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/front_end.hpp"

#include "segmentation/ground.hpp"
#include "segmentation/mounting.hpp"
#include "tracking/stage_timer.hpp"

namespace lego_loam_sc {

FrontEnd run_front_end(const Scan& scan, SensorModel& sensor, double& height,
                       const Settings& settings, bool find_tilt) {
  FrontEnd result;
  StageTimer timer(result.milliseconds);
  timer.start(Stage::projection);
  result.image = project(scan, sensor);
  if (find_tilt && estimate_tilt(result.image, sensor)) result.image = project(scan, sensor);
  if (height == 0.0)
    height = estimate_sensor_height(result.image, sensor, settings.segmentation).value_or(0.0);

  timer.start(Stage::segmentation);
  result.segmentation = segment(result.image, sensor, height, settings.segmentation);

  timer.start(Stage::features);
  result.features = extract_features(result.image, result.segmentation, sensor, settings.features);
  timer.stop();
  return result;
}

}  // namespace lego_loam_sc
