// SPDX-License-Identifier: BSD-3-Clause
#include "sim/lidar.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/time.hpp"
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
  Vector3d forward;        // horizontal direction
};

// The columns of a sweep in the order of storage.
std::vector<Firing> firings_by_azimuth(const SensorModel& sensor) {
  std::vector<Firing> firings;
  for (int i = 0; i < sensor.columns; ++i) {
    const double turn = static_cast<double>(i) / sensor.columns;
    const double swept_deg = sensor.clockwise ? -360.0 * turn : 360.0 * turn;
    const double azimuth_deg = std::fmod(sensor.start_azimuth_deg + swept_deg + 720.0, 360.0);
    firings.push_back({azimuth_deg,
                       static_cast<std::int32_t>(nanoseconds(turn * sensor.period)),
                       {std::cos(radians(azimuth_deg)), std::sin(radians(azimuth_deg)), 0.0}});
  }
  std::ranges::sort(firings, {}, &Firing::azimuth_deg);
  return firings;
}

// Cosine and sine of the elevation of each row.
using Elevations = std::vector<Eigen::Vector2d>;

Vector3d direction_of(const Firing& firing, const Eigen::Vector2d& elevation) {
  return elevation.x() * firing.forward + elevation.y() * Vector3d::UnitZ();
}

Elevations reported_elevations(const SensorModel& sensor) {
  Elevations result;
  for (const double deg : sensor.elevation_deg)
    result.emplace_back(std::cos(radians(deg)), std::sin(radians(deg)));
  return result;
}

// Where the beams point; the sensor reports the elevations of its table.
Elevations true_elevations(const SensorModel& sensor, const BeamErrors& errors) {
  Elevations result;
  for (std::size_t row = 0; row < sensor.elevation_deg.size(); ++row) {
    const double error = errors.elevation_deg.empty() ? 0.0 : errors.elevation_deg[row];
    const double angle =
        radians(sensor.elevation_deg[row] + sensor.elevation_correction_deg + error);
    result.emplace_back(std::cos(angle), std::sin(angle));
  }
  return result;
}

// A surface of reflectivity 0.1 hit at right angles gives a signal of 1 at half the maximum range;
// the signal falls with the square of the range, and noise hides ever more of the weak echoes.
double return_probability(const Hit& hit, double max_range) {
  const double relative_range = hit.range / (0.5 * max_range);
  const double signal =
      hit.reflectivity / 0.1 * hit.cos_incidence / std::max(relative_range * relative_range, 1e-6);
  return 1.0 - std::exp(-3.0 * signal);
}

Echo echo_of(const std::optional<Hit>& hit, double range_error, const SensorModel& sensor,
             const LidarSettings& settings, Random random) {
  if (!hit) return {};
  if (settings.drop_outs && !random.chance(return_probability(*hit, sensor.max_range))) return {};
  const double range = hit->range + range_error + settings.noise * random.gaussian();
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
           std::int64_t stamp_ns, const LidarSettings& settings, const Traffic& traffic) {
  const std::vector<Firing> firings = firings_by_azimuth(sensor);
  const std::size_t columns = firings.size();
  const auto rows = static_cast<std::size_t>(sensor.rows());
  const Elevations elevations = true_elevations(sensor, settings.beam_errors);
  const std::vector<double>& range_errors = settings.beam_errors.range;
  const std::uint64_t scan_key = hash(settings.seed, static_cast<std::uint64_t>(stamp_ns));
  // Noise may bring a point from beyond the maximum range back into it.
  const double reach = sensor.max_range + 5.0 * settings.noise;
  const std::vector<Traffic::Neighbour> neighbours =
      traffic.near(lidar_pose(stamp_ns).translation(), reach, stamp_ns, nanoseconds(sensor.period));

  std::vector<Echo> echoes(rows * columns);
  tbb::parallel_for(std::size_t{0}, columns, [&](std::size_t column) {
    const Firing& firing = firings[column];
    const std::int64_t time_ns = stamp_ns + firing.offset_ns;
    const Pose T_world_lidar = lidar_pose(settings.distort ? time_ns : stamp_ns);
    std::vector<Vector3d> directions;
    for (const Eigen::Vector2d& elevation : elevations)
      directions.emplace_back(T_world_lidar.linear() * direction_of(firing, elevation));
    std::vector<std::optional<Hit>> hits(rows);
    world.cast(T_world_lidar.translation(), directions, reach, hits);
    traffic.cast(neighbours, time_ns, T_world_lidar.translation(), directions, reach, hits);
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t ray = row * columns + column;
      echoes[ray] = echo_of(hits[row], range_errors.empty() ? 0.0 : range_errors[row], sensor,
                            settings, Random(hash(scan_key, ray)));
    }
  });

  const Elevations reported = reported_elevations(sensor);
  Scan scan;
  scan.stamp_ns = stamp_ns;
  for (std::size_t row = rows; row-- > 0;) {
    for (std::size_t column = 0; column < columns; ++column) {
      const Echo& echo = echoes[row * columns + column];
      if (echo.range == 0.0f) continue;
      const Vector3d direction = direction_of(firings[column], reported[row]);
      scan.points.emplace_back((echo.range * direction).cast<float>());
      scan.intensity.push_back(echo.intensity);
      scan.ring.push_back(static_cast<std::uint16_t>(row));
      if (settings.distort) scan.offset_ns.push_back(firings[column].offset_ns);
    }
  }
  return scan;
}

}  // namespace lego_loam_sc
