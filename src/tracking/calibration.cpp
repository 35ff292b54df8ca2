// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/calibration.hpp"

#include <utility>

namespace lego_loam_sc {

void Calibration::set_mounting(const Mounting& mounting) {
  sensor = mounted(std::move(sensor), mounting);
  height = mounting.height;
}

bool Calibration::correct_elevations(double bias, const std::vector<double>& row_bias) {
  if (sensor.tilted()) return false;
  sensor.elevation_correction_deg = nominal.elevation_correction_deg + degrees(bias);
  sensor.row_correction_deg.assign(sensor.elevation_deg.size(), 0.0);
  for (std::size_t row = 0; row < row_bias.size(); ++row)
    sensor.row_correction_deg[row] = degrees(row_bias[row]);
  return true;
}

Pose Calibration::to_lidar_frame(Pose T_frame_level) const {
  if (sensor.tilted()) T_frame_level.rotate(R_base_lidar(sensor));
  return T_frame_level;
}

}  // namespace lego_loam_sc
