// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world.hpp"

#include <array>

#include "io/error.hpp"
#include "sim/car_park.hpp"
#include "sim/street.hpp"

namespace lego_loam_sc {
namespace {

constexpr std::array<std::string_view, 2> kNames = {"parking", "street"};

}  // namespace

std::span<const std::string_view> world_names() {
  return kNames;
}

World make_world(std::string_view name, std::uint64_t seed) {
  if (name == "parking") return make_car_park(seed);
  if (name == "street") return make_street(seed);
  std::string known;
  for (const std::string_view& n : kNames) known += (known.empty() ? "" : ", ") + std::string(n);
  throw InputError("there is no world '" + std::string(name) + "', choose one of: " + known);
}

}  // namespace lego_loam_sc
