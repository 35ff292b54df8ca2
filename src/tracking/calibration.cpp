// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/calibration.hpp"

#include <optional>
#include <utility>

#include "segmentation/ground_profile.hpp"

namespace lego_loam_sc {
namespace {

// m; the same piece of road is no new evidence.
constexpr double kObservationSpacing = 5.0;

}  // namespace

void Calibration::set_mounting(const Mounting& mounting) {
  sensor = mounted(std::move(sensor), mounting);
  height = mounting.height;
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
