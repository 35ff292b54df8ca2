// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "sim/places.hpp"

namespace lego_loam_sc {
namespace {

constexpr WorldKind kKinds[] = {
    {"kitti00", "a city along a built-in route of 3.7 km, or along --route", make_kitti00,
     make_city},
    {"city", "a city along any --route", nullptr, make_city},
    {"parking", "one storey of a car park, a figure of eight of 260 m", make_parking},
    {"parking1", "the paper's scene 1: one storey of a car park, a loop of 180 m", make_parking1},
    {"parking2", "the paper's scene 2: two storeys alike, joined by ramps, a loop of 195 m",
     make_parking2},
    {"mine", "a mine's roadways, a loop of 600 m", make_mine},
    {"tunnel", "300 m of a tunnel with a constant cross-section", make_tunnel},
    {"field", "open ground with a few trees, a loop of 350 m", make_field},
    {"street", "a quarter of a town, a loop of 1.1 km", make_street},
};

std::string known_names() {
  std::string names;
  for (const WorldKind& kind : kKinds)
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

const WorldKind& kind_of(std::string_view name) {
  const auto kind = std::ranges::find(kKinds, name, &WorldKind::name);
  if (kind == std::end(kKinds))
    throw InputError("there is no world '" + std::string(name) +
                     "'; choose one of: " + known_names());
  return *kind;
}

}  // namespace

std::span<const WorldKind> world_kinds() {
  return kKinds;
}

World make_world(std::string_view name, std::uint64_t seed) {
  const WorldKind& kind = kind_of(name);
  if (!kind.make)
    throw InputError("the world '" + std::string(name) +
                     "' needs a route; give a file of poses with --route");
  return kind.make(seed);
}

World make_world(std::string_view name, std::uint64_t seed, const Trajectory& route) {
  const WorldKind& kind = kind_of(name);
  if (!kind.make_along)
    throw InputError("the world '" + std::string(name) +
                     "' has a fixed route; --route is for city and kitti00");
  return kind.make_along(seed, route);
}

}  // namespace lego_loam_sc
