// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "sim/mesh.hpp"
#include "sim/motion.hpp"

namespace lego_loam_sc {

/// A place to scan and the way through it.
struct World {
  std::string_view sensor;  ///< preset that suits the place
  double sensor_height;     ///< m above the ground, for sensors that do not state their own
  Mesh mesh;
  Motion motion;         ///< of the vehicle that carries the sensor
};

std::span<const std::string_view> world_names();

/// Builds a world; the same seed gives the same world. Throws InputError for an unknown name.
World make_world(std::string_view name, std::uint64_t seed);

}  // namespace lego_loam_sc
