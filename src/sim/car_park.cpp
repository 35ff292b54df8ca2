// SPDX-License-Identifier: BSD-3-Clause
#include "sim/car_park.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/drive.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The plan, m. Aisles run along x, cross aisles along y.
constexpr double kLength = 80.0, kWidth = 50.0, kCeiling = 2.8;
constexpr std::array<double, 3> kAisles = {8.4, 25.0, 41.6};
constexpr std::array<double, 3> kCrossAisles = {7.0, 40.0, 73.0};
constexpr std::array<double, 6> kBayRows = {2.6, 14.1, 19.3, 30.7, 35.9, 47.4};
constexpr std::array<double, 2> kBayBlocks = {10.5, 44.5};  // where the bays of a row begin
constexpr int kBaysInBlock = 10;
constexpr double kBayWidth = 2.5;
constexpr double kRampLow = 22.0, kRampHigh = 28.0, kRampLength = 16.0;

constexpr double kConcrete = 0.35, kAsphalt = 0.2, kRubber = 0.1, kSteel = 0.4, kPaint = 0.7;

struct Bump {
  double x, y;  // of its middle
};
constexpr std::array<Bump, 4> kBumps = {
    {{30.0, kAisles[1]}, {60.0, kAisles[1]}, {55.0, kAisles[2]}, {25.0, kAisles[0]}}};
constexpr double kBumpHeight = 0.05, kBumpAlong = 0.4, kBumpAcross = 2.6;  // half extents

double hump(double offset, double half_extent) {
  if (std::abs(offset) >= half_extent) return 0.0;
  return 0.5 + 0.5 * std::cos(std::numbers::pi * offset / half_extent);
}

double floor_height(double x, double y) {
  const double shoulder = 0.5;
  double height = 0.0;
  for (const Bump& b : kBumps) {
    const double beside = std::max(0.0, std::abs(y - b.y) - (kBumpAcross - shoulder));
    height += kBumpHeight * hump(x - b.x, kBumpAlong) * hump(beside, shoulder);
  }
  return height;
}

Pose place(double x, double y, double z = 0.0, double yaw_deg = 0.0) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(radians(yaw_deg), Vector3d::UnitZ());
}

void add_floor_and_ceiling(Mesh& mesh) {
  for (const auto& [z, reflectivity] : {std::pair(0.0, kAsphalt), std::pair(kCeiling, kConcrete)})
    add_quad(mesh,
             {Vector3d(0, 0, z), Vector3d(kLength, 0, z), Vector3d(kLength, kWidth, z),
              Vector3d(0, kWidth, z)},
             reflectivity);
  for (const Bump& b : kBumps)
    add_height_field(mesh, floor_height, {b.x - kBumpAlong, b.y - kBumpAcross},
                     {b.x + kBumpAlong, b.y + kBumpAcross}, 0.1, 0.001, kRubber);
  for (double x = 3.75; x < kLength; x += 7.5)
    add_box(mesh, place(x, 0.5 * kWidth, kCeiling - 0.4), {0.35, kWidth, 0.4}, kConcrete);
}

// A wall in panels that stand back by different amounts, with doors, pilasters and cabinets. The
// room lies to the left of the way from `start` to `end`.
void add_wall(Mesh& mesh, const Vector2d& start, const Vector2d& end, Random& random) {
  const Vector2d along = (end - start).normalized();
  Pose wall = place(start.x(), start.y(), 0.0, degrees(std::atan2(along.y(), along.x())));
  const auto panel = [&](double xa, double ya, double xb, double yb, double reflectivity) {
    add_quad(mesh,
             {wall * Vector3d(xa, ya, 0), wall * Vector3d(xb, yb, 0),
              wall * Vector3d(xb, yb, kCeiling), wall * Vector3d(xa, ya, kCeiling)},
             reflectivity);
  };
  const double total = (end - start).norm();
  double x = 0.0;
  double setback = 0.0;
  while (x < total) {
    const bool is_door = random.chance(0.2);
    const double next = std::min(total, x + (is_door ? 1.2 : random.uniform(2.5, 6.0)));
    const double next_setback = is_door ? 0.3 : random.chance(0.5) ? 0.0 : 0.15;
    panel(x, -setback, x, -next_setback, kConcrete);
    panel(x, -next_setback, next, -next_setback, is_door ? kPaint : kConcrete);
    if (!is_door && random.chance(0.4))
      add_box(mesh, wall * Eigen::Translation3d(x, 0.05, 0.0), {0.4, 0.5, kCeiling}, kConcrete);
    if (!is_door && random.chance(0.2))
      add_box(mesh, wall * Eigen::Translation3d(0.5 * (x + next), 0.15, 0.6), {0.8, 0.3, 1.1},
              kSteel);
    x = next;
    setback = next_setback;
  }
  panel(total, -setback, total, 0.0, kConcrete);
}

void add_ramp(Mesh& mesh) {
  const double end = kLength + kRampLength;
  add_quad(mesh,
           {Vector3d(kLength, kRampLow, 0), Vector3d(end, kRampLow, kCeiling),
            Vector3d(end, kRampHigh, kCeiling), Vector3d(kLength, kRampHigh, 0)},
           kAsphalt);
  for (const double y : {kRampLow, kRampHigh}) {
    add_box(mesh, place(0.5 * (kLength + end), y), {kRampLength, 0.3, 6.0}, kConcrete);
    add_box(mesh, place(kLength + 3.0, y, 0.8), {6.0, 0.4, 0.15}, kSteel);  // a crash rail
  }
  add_box(mesh, place(end, 0.5 * (kRampLow + kRampHigh)), {0.3, kRampHigh - kRampLow, 6.0}, kSteel);
}

void add_walls(Mesh& mesh, Random& random) {
  add_wall(mesh, {0, 0}, {kLength, 0}, random);
  add_wall(mesh, {kLength, 0}, {kLength, kRampLow}, random);
  add_wall(mesh, {kLength, kRampHigh}, {kLength, kWidth}, random);
  add_wall(mesh, {kLength, kWidth}, {0, kWidth}, random);
  add_wall(mesh, {0, kWidth}, {0, 0}, random);
  // The stair core and a store stand in the room.
  add_box(mesh, place(1.6, 33.0), {3.2, 7.0, kCeiling}, kConcrete);
  add_box(mesh, place(3.22, 34.5), {0.06, 1.1, 2.1}, kPaint);
  add_box(mesh, place(78.2, 8.0), {3.6, 5.0, kCeiling}, kConcrete);
}

void add_parked_cars(Mesh& mesh, Random& random) {
  for (const double row : kBayRows) {
    for (const double block : kBayBlocks) {
      for (int bay = 0; bay < kBaysInBlock; ++bay) {
        if (random.chance(0.25)) continue;
        const double x = block + (bay + 0.5) * kBayWidth + random.uniform(-0.15, 0.15);
        const double heading = random.chance(0.5) ? 90.0 : -90.0;
        const double yaw = heading + random.uniform(-3.0, 3.0);
        add_car(mesh, place(x, row + random.uniform(-0.25, 0.25), 0.0, yaw), random);
      }
    }
  }
}

void add_columns(Mesh& mesh) {
  for (const double block : kBayBlocks) {
    for (int bay = 0; bay <= kBaysInBlock; bay += 2) {
      const double x = block + bay * kBayWidth;
      for (const double y : {16.7, 33.3})
        add_box(mesh, place(x, y), {0.4, 0.4, kCeiling}, kConcrete);
      for (const double y : {5.0, 45.0}) add_cylinder(mesh, place(x, y), 0.16, kCeiling, kConcrete);
      for (const double y : {16.7, 33.3})  // painted edge guards
        add_box(mesh, place(x, y), {0.44, 0.44, 1.0}, kPaint);
    }
  }
}

void add_fittings(Mesh& mesh, Random& random) {
  for (const double aisle : kAisles) {
    for (const auto& [offset, radius] : {std::pair(-2.2, 0.08), std::pair(1.9, 0.05)}) {
      Pose pipe = place(0.0, aisle + offset, 2.3);
      pipe.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitY()));
      add_cylinder(mesh, pipe, radius, kLength, kSteel);
    }
    for (double x = 6.0; x < kLength; x += 6.0)  // lamps
      add_box(mesh, place(x + random.uniform(-0.5, 0.5), aisle, kCeiling - 0.2), {1.5, 0.15, 0.1},
              kPaint);
  }
  // Bollards at the corners of the rows; ticket pillars and signs beside the cross aisles.
  for (const double cross : kCrossAisles) {
    for (const double y : {12.0, 21.4, 28.6, 38.0}) {
      add_cylinder(mesh, place(cross - 3.0, y), 0.08, 1.0, kPaint);
      if (random.chance(0.5)) add_box(mesh, place(cross + 3.1, y), {0.35, 0.3, 1.4}, kSteel);
      add_box(mesh, place(cross + random.uniform(-1.0, 1.0), y, 2.1), {1.0, 0.08, 0.3}, kPaint);
    }
  }
}

Mesh make_mesh(std::uint64_t seed) {
  Mesh mesh;
  Random random(seed);
  add_floor_and_ceiling(mesh);
  add_ramp(mesh);
  add_walls(mesh, random);
  add_parked_cars(mesh, random);
  add_columns(mesh);
  add_fittings(mesh, random);
  return mesh;
}

Drive make_drive(std::uint64_t seed) {
  const auto [west, middle, east] = kCrossAisles;
  const auto [south, centre, north] = kAisles;
  const Vector2d start(18.0, centre);
  const std::vector<Vector2d> waypoints = {start,           {east, centre},
                                           {east, north},   {west, north},
                                           {west, centre},  {middle, centre},
                                           {middle, south}, {west, south},
                                           {west, centre},  start};
  const DriveSettings settings{
      .speed = 1.5,
      .acceleration = 0.4,
      .lateral_acceleration = 0.4,
      .wheel_base = 1.2,
      .track_width = 0.9,
      .shaking = {.roll_deg = 0.5, .pitch_deg = 0.5, .yaw_deg = 0.25, .z = 0.008},
      .seed = hash(seed, 1)};
  return Drive(Route(waypoints, 4.0), floor_height, settings);
}

}  // namespace

World make_car_park(std::uint64_t seed) {
  return {.sensor = "rs16",
          .sensor_height = 0.9,
          .mesh = make_mesh(seed),
          .motion = motion_of(make_drive(seed))};
}

}  // namespace lego_loam_sc
