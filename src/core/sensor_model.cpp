// SPDX-License-Identifier: BSD-3-Clause
#include "core/sensor_model.hpp"

#include <algorithm>

#include "core/pose.hpp"

namespace lego_loam_sc {

double row_spacing(const SensorModel& sensor) {
  std::vector<double> steps;
  for (int row = 1; row < sensor.rows(); ++row)
    steps.push_back(sensor.elevation_deg[row] - sensor.elevation_deg[row - 1]);
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + steps.size() / 2;
  std::nth_element(steps.begin(), middle, steps.end());
  return radians(*middle);
}

Eigen::Matrix3d R_base_lidar(const SensorModel& sensor) {
  return rotation_from_rpy(radians(sensor.mount_roll_deg), radians(sensor.mount_pitch_deg), 0.0);
}

}  // namespace lego_loam_sc
