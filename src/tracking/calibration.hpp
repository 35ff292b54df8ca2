// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "core/sensor_model.hpp"
#include "tracking/front_end.hpp"

namespace lego_loam_sc {

/// The sensor as its model states it, and with what the scans have shown.
struct Calibration {
  explicit Calibration(const SensorModel& model)
      : nominal(model), sensor(model), height(model.height) {}

  SensorModel nominal;
  SensorModel sensor;  ///< with the tilt and the elevation angles that were found on the way
  double height;       ///< m above the ground, 0 = not known yet

  /// Takes what the front end found of the mounting.
  void set_mounting(const Mounting& mounting);

  /// Takes the error of the elevation angles (rad) that all rows have in common, and that of each
  /// row besides; empty when unknown. It is measured along the vertical axis, about which only an
  /// upright sensor spins: false, and nothing changes, when the sensor is tilted.
  bool correct_elevations(double bias, const std::vector<double>& row_bias);

  /// The tracker has the LiDAR's axes turned level; this gives the pose of the LiDAR.
  Pose to_lidar_frame(Pose T_frame_level) const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(sensor.mount_roll_deg, sensor.mount_pitch_deg, sensor.elevation_correction_deg,
            sensor.row_correction_deg, height);
  }
};

}  // namespace lego_loam_sc
