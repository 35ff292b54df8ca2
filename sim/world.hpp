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

/// A place to scan and the way through it.
struct World {
  std::string_view sensor;  ///< preset that suits the place
  double sensor_height;     ///< m above the ground, for sensors that do not state their own
  Mesh mesh;
  Motion motion;                                     ///< of the vehicle that carries the sensor
  TrafficPlan traffic = {};                          ///< what else moves
  std::optional<double> range_noise = std::nullopt;  ///< m, one sigma; nothing: as the sensor says
  bool worn_sensor = false;  ///< the sensor comes with the errors of a used one
};

/// A line of the table of worlds.
struct WorldKind {
  std::string_view name;
  std::string_view description;  ///< for the help of the program
  /// None: it needs a route.
  World (*make)(std::uint64_t seed) = nullptr;
  /// None: it has a way of its own.
  World (*make_along)(std::uint64_t seed, const Trajectory& route) = nullptr;
};

/// All worlds.
std::span<const WorldKind> world_kinds();

/// Builds a world; the same seed gives the same world. Throws InputError for an unknown name and
/// for a world that needs a route.
World make_world(std::string_view name, std::uint64_t seed);

/// Builds a world round a route: T_world_lidar with stamps. Throws InputError for an unknown name
/// and for a world that has its own way.
World make_world(std::string_view name, std::uint64_t seed, const Trajectory& route);

}  // namespace lego_loam_sc
