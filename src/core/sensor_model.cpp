// SPDX-License-Identifier: BSD-3-Clause
#include "core/sensor_model.hpp"

#include "core/pose.hpp"

namespace lego_loam_sc {

Eigen::Matrix3d R_base_lidar(const SensorModel& sensor) {
  return rotation_from_rpy(radians(sensor.mount_roll_deg), radians(sensor.mount_pitch_deg), 0.0);
}

}  // namespace lego_loam_sc
