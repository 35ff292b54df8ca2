// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/calibration.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "segmentation/ground_profile.hpp"
#include "segmentation/mounting.hpp"

namespace lego_loam_sc {
namespace {

// m; the same piece of road is no new evidence.
constexpr double kObservationSpacing = 5.0;
// Between the tilts that two scans show; the ground and the vehicle's springs make as much.
constexpr double kSameTiltDeg = 5.0;

}  // namespace

void Calibration::set_mounting(const Mounting& mounting) {
  sensor = mounted(std::move(sensor), mounting);
  height = mounting.height;
}

bool Calibration::shows_tilt(const Scan& scan) const {
  SensorModel seen = nominal;
  if (!estimate_tilt(project(scan, nominal), seen)) return false;
  const Eigen::Vector3d up = R_base_lidar(sensor).row(2);
  const Eigen::Vector3d up_seen = R_base_lidar(seen).row(2);
  return up.dot(up_seen) > std::cos(radians(kSameTiltDeg));
}

void Calibration::observe_ground(const FrontEnd& front_end, double travelled) {
  if (sensor.tilted() || travelled < next_observation_) return;
  const std::optional<double> cone = cone_of_ground(front_end.image, front_end.segmentation);
  if (!cone) return;
  next_observation_ = travelled + kObservationSpacing;
  elevation_bias_.add(radians(elevation_bias_deg()) + *cone);
  sensor.elevation_correction_deg = nominal.elevation_correction_deg + elevation_bias_deg();
}

Pose Calibration::to_lidar_frame(Pose T_frame_level) const {
  if (sensor.tilted()) T_frame_level.rotate(R_base_lidar(sensor));
  return T_frame_level;
}

}  // namespace lego_loam_sc
