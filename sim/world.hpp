// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/trajectory.hpp"
#include "sim/mesh.hpp"
#include "sim/motion.hpp"
#include "sim/traffic.hpp"

namespace lego_loam_sc {

/// A world to scan: its geometry, the motion of the vehicle and the traffic.
struct World {
  std::string_view sensor;  ///< suitable sensor preset
  double sensor_height;     ///< m above the ground, for sensors without a height
  Mesh mesh;
  Motion motion;                                     ///< of the vehicle that carries the sensor
  TrafficPlan traffic = {};                          ///< moving objects
  std::optional<double> range_noise = std::nullopt;  ///< m, one sigma; nothing: that of the sensor
  bool worn_sensor = false;  ///< whether the sensor has the errors of used_beams
};

/// An entry of the table of worlds.
struct WorldKind {
  std::string_view name;
  std::string_view description;  ///< for the help of the program
  /// Null: the world needs a route.
  World (*make)(std::uint64_t seed) = nullptr;
  /// Null: the world has a fixed route.
  World (*make_along)(std::uint64_t seed, const Trajectory& route) = nullptr;
};

/// All worlds.
std::span<const WorldKind> world_kinds();

/// Builds a world, which its seed determines. Throws InputError for an unknown name and
/// for a world that needs a route.
World make_world(std::string_view name, std::uint64_t seed);

/// Builds a world along a route: T_world_lidar with stamps. Throws InputError for an unknown name
/// and for a world with a fixed route.
World make_world(std::string_view name, std::uint64_t seed, const Trajectory& route);

}  // namespace lego_loam_sc
