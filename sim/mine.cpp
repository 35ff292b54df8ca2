// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>
#include <vector>

#include "sim/drive.hpp"
#include "sim/mine_fittings.hpp"
#include "sim/noise.hpp"
#include "sim/places.hpp"
#include "sim/random.hpp"
#include "sim/roadway.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCornerRadius = 12.0;  // m
constexpr double kDrivenTwice = 40.0;   // m
constexpr double kSideScale = 0.92;     // of cross-cuts and dead ends

// The plan, m. The loop is driven in the order of its points, counter-clockwise.
std::vector<Vector2d> loop() {
  return {{28, 1.2}, {70, 3},  {140, -2}, {212, 0}, {215, 46}, {212, 92},
          {130, 95}, {60, 90}, {0, 92},   {-3, 46}, {0, 0},    {28, 1.2}};
}

// Where cross-cuts and dead ends branch off, their first point lies on the loop's line.
std::vector<std::vector<Vector2d>> branches() {
  return {{{40, 1.7}, {38, 90.7}}, {{105, 0.5}, {108, 93.4}}, {{170, -1.2}, {172, 93.5}},
          {{80, 2.3}, {82, -14}},  {{150, -1.7}, {153, -17}}, {{214.5, 46}, {233, 48}},
          {{20, 91.3}, {18, 107}}};
}

// The seam rises and falls, and the floor is uneven. Gravel and ridges are not felt by the vehicle.
Ground mine_floor(std::uint64_t seed) {
  return [seed](double x, double y) {
    return 3.6 * std::sin(x / 40.0) + 2.0 * std::cos(y / 35.0) +
           0.06 * smooth_noise(Vector3d(x, y, 0.0) / 3.0, seed);
  };
}

std::vector<Roadway> make_roadways(const Rock& rock) {
  std::vector<Roadway> roadways = {Roadway(loop(), kCornerRadius, 1.0, rock)};
  for (const std::vector<Vector2d>& branch : branches())
    roadways.emplace_back(branch, kCornerRadius, kSideScale, rock);
  return roadways;
}

Mesh make_mesh(const Rock& rock, std::uint64_t seed) {
  const std::vector<Roadway> roadways = make_roadways(rock);
  Mesh mesh;
  add_roadways(mesh, roadways);
  Random random(seed);
  const Roadway& main = roadways.front();
  add_pipes(mesh, main, 0.0, main.line().length());
  add_conveyor(mesh, main, 281.0, 441.0);
  for (const auto& [from, to] : {std::pair(83.0, 116.0), {321.0, 366.0}, {501.0, 546.0}})
    add_steel_arches(mesh, main, from, to, random);
  for (const auto& [from, to] : {std::pair(191.0, 222.0), {238.0, 266.0}})
    add_props(mesh, main, from, to, random);
  add_clutter(mesh, main, 0.0, main.line().length(), random);
  add_loader(mesh, roadways[2].at(30.0));
  add_loader(mesh, roadways[4].at(10.0));
  add_loader(mesh, roadways[6].at(11.0));
  return mesh;
}

Drive make_drive(const Rock& rock, std::uint64_t seed) {
  std::vector<Vector2d> waypoints = loop();
  const Vector2d along = (waypoints[1] - waypoints[0]).normalized();
  waypoints.back() += kDrivenTwice * along;
  const DriveSettings settings{
      .speed = 2.5,
      .acceleration = 0.5,
      .lateral_acceleration = 0.6,
      .wheel_base = 1.8,
      .track_width = 1.2,
      .shaking = {.roll_deg = 0.6, .pitch_deg = 0.6, .yaw_deg = 0.3, .z = 0.012},
      .seed = hash(seed, 1)};
  return {Route(waypoints, kCornerRadius), rock.floor, settings};
}

}  // namespace

World make_mine(std::uint64_t seed) {
  const Rock rock{.floor = mine_floor(hash(seed, 2)), .seed = hash(seed, 3)};
  return {.sensor = "rs16",
          .sensor_height = 1.2,
          .mesh = make_mesh(rock, seed),
          .motion = motion_of(make_drive(rock, seed))};
}

}  // namespace lego_loam_sc
