// SPDX-License-Identifier: BSD-3-Clause
#include "sim/lidar.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

// One ray's outcome; range 0 means "no return".
struct Echo {
  float range = 0.0f;
  float intensity = 0.0f;
};

// One column: all beams fire together.
struct Firing {
  double azimuth_deg;      // counter-clockwise from x, in [0, 360)
  std::int32_t offset_ns;  // after the stamp
};

// The columns of a sweep in the order of storage.
std::vector<Firing> firings_by_azimuth(const SensorModel& sensor) {
  std::vector<Firing> firings;
  for (int i = 0; i < sensor.columns; ++i) {
    const double turn = static_cast<double>(i) / sensor.columns;
    const double swept_deg = sensor.clockwise ? -360.0 * turn : 360.0 * turn;
    firings.push_back({std::fmod(sensor.start_azimuth_deg + swept_deg + 720.0, 360.0),
                       static_cast<std::int32_t>(std::llround(turn * sensor.period * 1e9))});
  }
  std::ranges::sort(firings, {}, &Firing::azimuth_deg);
  return firings;
}

Vector3d direction_of(double azimuth_deg, double elevation_deg) {
  const double azimuth = radians(azimuth_deg), elevation = radians(elevation_deg);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

// A surface of reflectivity 0.1 hit at right angles gives a signal of 1 at half the maximum range;
// the signal falls with the square of the range, and noise hides ever more of the weak echoes.
double return_probability(const Hit& hit, double max_range) {
  const double relative_range = hit.range / (0.5 * max_range);
  const double signal =
      hit.reflectivity / 0.1 * hit.cos_incidence / std::max(relative_range * relative_range, 1e-6);
  return 1.0 - std::exp(-3.0 * signal);
}

Echo echo_of(const std::optional<Hit>& hit, const SensorModel& sensor,
             const LidarSettings& settings, Random random) {
  if (!hit) return {};
  if (settings.drop_outs && !random.chance(return_probability(*hit, sensor.max_range))) return {};
  const double range = hit->range + settings.noise * random.gaussian();
  if (!(range >= sensor.min_range && range <= sensor.max_range)) return {};
  return {static_cast<float>(range), static_cast<float>(hit->reflectivity * hit->cos_incidence)};
}

}  // namespace

Pose mounting(const SensorModel& sensor, double default_height) {
  Pose T_vehicle_lidar = Pose::Identity();
  T_vehicle_lidar.translation().z() = sensor.height > 0.0 ? sensor.height : default_height;
  T_vehicle_lidar.linear() =
      rotation_from_rpy(radians(sensor.mount_roll_deg), radians(sensor.mount_pitch_deg), 0.0);
  return T_vehicle_lidar;
}

Scan sweep(const RayCaster& world, const SensorModel& sensor, const LidarPose& lidar_pose,
           std::int64_t stamp_ns, const LidarSettings& settings) {
  const std::vector<Firing> firings = firings_by_azimuth(sensor);
  const std::size_t columns = firings.size();
  const auto rows = static_cast<std::size_t>(sensor.rows());
  const std::uint64_t scan_key = hash(settings.seed, static_cast<std::uint64_t>(stamp_ns));
  // Noise may bring a point from beyond the maximum range back into it.
  const double reach = sensor.max_range + 5.0 * settings.noise;

  std::vector<Echo> echoes(rows * columns);
  tbb::parallel_for(std::size_t{0}, columns, [&](std::size_t column) {
    const Firing& firing = firings[column];
    const Pose T_world_lidar = lidar_pose(stamp_ns + (settings.distort ? firing.offset_ns : 0));
    for (std::size_t row = 0; row < rows; ++row) {
      // The beam's true elevation; the sensor reports the one of its table.
      const double elevation_deg = sensor.elevation_deg[row] + sensor.elevation_correction_deg;
      const Vector3d direction =
          T_world_lidar.linear() * direction_of(firing.azimuth_deg, elevation_deg);
      const std::size_t ray = row * columns + column;
      echoes[ray] = echo_of(world.cast(T_world_lidar.translation(), direction, reach), sensor,
                            settings, Random(hash(scan_key, ray)));
    }
  });

  Scan scan;
  scan.stamp_ns = stamp_ns;
  for (std::size_t row = rows; row-- > 0;) {
    for (std::size_t column = 0; column < columns; ++column) {
      const Echo& echo = echoes[row * columns + column];
      if (echo.range == 0.0f) continue;
      const Vector3d direction =
          direction_of(firings[column].azimuth_deg, sensor.elevation_deg[row]);
      scan.points.push_back((echo.range * direction).cast<float>());
      scan.intensity.push_back(echo.intensity);
      scan.ring.push_back(static_cast<std::uint16_t>(row));
      if (settings.distort) scan.offset_ns.push_back(firings[column].offset_ns);
    }
  }
  return scan;
}

}  // namespace lego_loam_sc
