// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace lego_loam_sc {

/// Properties of one spinning LiDAR and its mounting; loaded from config/sensors/*.yaml.
struct SensorModel {
  std::string name;
  std::vector<double> elevation_deg;  ///< one per row, row 0 = lowest beam, ascending
  int columns = 1800;                 ///< columns of the range image over 360 degrees
  double min_range = 1.0;             ///< m; closer points are on the vehicle or the sensor
  double max_range = 100.0;           ///< m
  double range_noise = 0.02;          ///< m, one sigma
  double period = 0.1;                ///< s per revolution
  double start_azimuth_deg = 180.0;   ///< azimuth (counter-clockwise from x) where a sweep starts
  bool clockwise = true;              ///< seen from above
  bool motion_compensated = false;    ///< points are already de-skewed to the stamp of the scan
  bool times_from_azimuth = false;    ///< raw sweeps without times: computed from the azimuth
  double elevation_correction_deg = 0.0;  ///< added to the elevation angle of every point
  // Mounting; all zero: unknown, estimated from the scans. Points are processed in the levelled
  // frame, R_base_lidar = R_y(pitch) R_x(roll).
  double height = 0.0;  ///< m above the ground, 0 = unknown
  double mount_roll_deg = 0.0;
  double mount_pitch_deg = 0.0;

  /// Number of beams.
  int rows() const { return static_cast<int>(elevation_deg.size()); }
  /// Whether the mounting is not level.
  bool tilted() const { return mount_roll_deg != 0.0 || mount_pitch_deg != 0.0; }
};

/// rad; median elevation step from one row to the next, 0 for a single row.
double row_spacing(const SensorModel& sensor);

/// The rotation from the LiDAR's axes to levelled axes, from the mounting angles.
Eigen::Matrix3d R_base_lidar(const SensorModel& sensor);

/// The first invalid field of the model as one sentence, or nothing.
std::optional<std::string> validate(const SensorModel& sensor);

}  // namespace lego_loam_sc
