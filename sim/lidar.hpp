// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "core/pose.hpp"
#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "sim/beam_errors.hpp"
#include "sim/ray_caster.hpp"
#include "sim/traffic.hpp"

namespace lego_loam_sc {

/// Errors of the simulated measurements.
struct LidarSettings {
  /// Each column is measured from the pose at its own firing time; off: all from the pose at the
  /// stamp, as after perfect motion compensation.
  bool distort = true;
  double noise = 0.0;           ///< m; one sigma of the range
  BeamErrors beam_errors = {};  ///< empty: the beams match the sensor model
  bool drop_outs = true;        ///< weak echoes are lost
  std::uint64_t seed = 0;
};

/// T_world_lidar at a time; called concurrently.
using LidarPose = std::function<Pose(std::int64_t time_ns)>;

/// T_vehicle_lidar: `default_height` (m) over the vehicle frame unless the
/// sensor states its own, tilted by the mounting angles.
Pose mounting(const SensorModel& sensor, double default_height);

/// One revolution of the sensor, starting at `stamp_ns`.
///
/// The points are in the LiDAR frame of their own firing time, stored as KITTI stores them: ring by
/// ring from the top, each ring with the azimuth ascending from straight ahead; `ring` counts rows
/// of the sensor model, from the lowest. All beams of a column fire together, the columns at equal
/// intervals from the start azimuth; traffic moves on from column to column, in a scan without
/// distortion too. The points lie in the directions of the sensor model, even when the beams have
/// errors. Directions without an echo are omitted. `intensity` is reflectivity times the cosine of
/// the incidence, 0 to 1. Noise and drop-outs depend on the seed, the stamp and the beam alone, not
/// on the number of threads.
Scan sweep(const RayCaster& world, const SensorModel& sensor, const LidarPose& lidar_pose,
           std::int64_t stamp_ns, const LidarSettings& settings,
           const Traffic& traffic = Traffic());

}  // namespace lego_loam_sc
