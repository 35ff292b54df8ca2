// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/drive.hpp"
#include "sim/noise.hpp"
#include "sim/places.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kGrass = 0.3;                      // reflectivity
constexpr double kGrassCell = 0.4, kFarCell = 4.0;  // m
constexpr double kTreeClearance = 5.0;              // m between a tree and the drive

// m. Grass is drawn where the drive comes near, smooth ground as far as the sensor sees.
const Vector2d kNearLow(-35.0, -35.0), kNearHigh(155.0, 125.0);
const Vector2d kFarLow(-180.0, -180.0), kFarHigh(300.0, 270.0);
const Vector2d kTreesLow(-70.0, -70.0), kTreesHigh(190.0, 160.0);

Route make_route() {
  const std::vector<Vector2d> waypoints = {{50, 0},   {84, 0},  {114, 14}, {122, 42},
                                           {110, 72}, {78, 88}, {36, 82},  {4, 60},
                                           {0, 24},   {18, 0},  {50, 0}};
  return {waypoints, 25.0};
}

double hills(double x, double y) {
  return 1.5 * std::sin(x / 50.0) + 1.2 * std::cos(y / 42.0) + 0.5 * std::sin((x + y) / 23.0);
}

void add_ground(Mesh& mesh, std::uint64_t seed) {
  const auto grass = [seed](double x, double y) {
    return hills(x, y) + 0.05 * smooth_noise(Vector3d(x, y, 0.0) / 0.9, seed) +
           0.02 * smooth_noise(Vector3d(x, y, 7.0) / 0.4, seed);
  };
  // Under the grass the smooth ground sinks away, and meets it at its edge.
  const auto sunk = [](double x, double y) {
    const double inside =
        std::min({x - kNearLow.x(), kNearHigh.x() - x, y - kNearLow.y(), kNearHigh.y() - y});
    return hills(x, y) - 0.3 * std::clamp(inside / (2.0 * kFarCell), 0.0, 1.0);
  };
  add_height_field(mesh, grass, kNearLow, kNearHigh, kGrassCell, 0.0, kGrass);
  add_height_field(mesh, sunk, kFarLow, kFarHigh, kFarCell, 0.0, kGrass);
}

// A place for a tree that leaves the drive room.
Vector2d free_place(const Route& route, Random& random) {
  while (true) {
    const double x = random.uniform(kTreesLow.x(), kTreesHigh.x());
    const double y = random.uniform(kTreesLow.y(), kTreesHigh.y());
    double nearest = kTreeClearance;
    for (double s = 0.0; s < route.length(); s += 1.0)
      nearest = std::min(nearest, (route.at(s).position - Vector2d(x, y)).norm());
    if (nearest == kTreeClearance) return {x, y};
  }
}

void add_plants(Mesh& mesh, std::uint64_t seed) {
  Random random(seed);
  const Route route = make_route();
  const auto anywhere = [&]() -> Pose {
    const Vector2d place = free_place(route, random);
    return Eigen::Translation3d(place.x(), place.y(), hills(place.x(), place.y())) *
           Eigen::AngleAxisd(random.uniform(-3.0, 3.0), Vector3d::UnitZ());
  };
  for (int tree = 0; tree < 55; ++tree) add_tree(mesh, anywhere(), random);
  for (int bush = 0; bush < 12; ++bush) {
    const Pose place = anywhere();
    add_hedge(mesh, place, random.uniform(1.0, 3.0), random);
  }
}

Mesh make_mesh(std::uint64_t seed) {
  Mesh mesh;
  add_ground(mesh, hash(seed, 2));
  add_plants(mesh, hash(seed, 3));
  return mesh;
}

Drive make_drive(std::uint64_t seed) {
  const DriveSettings settings{
      .speed = 3.0,
      .acceleration = 0.7,
      .lateral_acceleration = 0.8,
      .wheel_base = 1.8,
      .track_width = 1.2,
      .shaking = {.roll_deg = 0.8, .pitch_deg = 0.8, .yaw_deg = 0.3, .z = 0.015},
      .seed = hash(seed, 1)};
  return {make_route(), hills, settings};
}

}  // namespace

World make_field(std::uint64_t seed) {
  return {.sensor = "rs16",
          .sensor_height = 1.2,
          .mesh = make_mesh(seed),
          .motion = motion_of(make_drive(seed))};
}

}  // namespace lego_loam_sc
