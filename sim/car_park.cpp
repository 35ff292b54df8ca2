// SPDX-License-Identifier: BSD-3-Clause
#include <utility>
#include <vector>

#include "sim/concrete.hpp"
#include "sim/drive.hpp"
#include "sim/places.hpp"
#include "sim/random.hpp"
#include "sim/storey.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSensorHeight = 0.9;           // m
constexpr double kBump = 0.05, kGully = -0.03;  // m

// What all the halls have in common: three aisles along x in a width of 50 m.
StoreyPlan hall(double length) {
  StoreyPlan plan;
  plan.length = length;
  plan.width = 50.0;
  plan.aisles = {8.4, 25.0, 41.6};
  plan.bay_rows = {2.6, 14.1, 19.3, 30.7, 35.9, 47.4};
  plan.square_columns = {16.7, 33.3};
  plan.round_columns = {5.0, 45.0};
  return plan;
}

StoreyPlan parking_plan() {
  StoreyPlan plan = hall(80.0);
  plan.cross_aisles = {7.0, 40.0, 73.0};
  plan.bay_blocks = {{10.5, 10}, {44.5, 10}};
  plan.cores = {{{1.6, 33.0}, {3.2, 7.0}}, {{78.2, 8.0}, {3.6, 5.0}}};
  plan.openings = {{{80.0, 25.0}, 6.0}};
  plan.bumps = {{30.0, 25.0, kBump}, {60.0, 25.0, kBump}, {55.0, 41.6, kBump}, {25.0, 8.4, kBump}};
  return plan;
}

StoreyPlan parking1_plan() {
  StoreyPlan plan = hall(76.0);
  plan.cross_aisles = {7.0, 38.0, 69.0};
  plan.bay_blocks = {{11.0, 9}, {42.0, 9}};
  plan.cores = {{{1.6, 34.0}, {3.2, 7.0}}, {{74.2, 42.0}, {3.6, 5.0}}};
  plan.openings = {{{0.0, 25.0}, 6.0}, {{76.0, 8.4}, 6.0}};
  plan.bumps = {{20.0, 8.4, kBump},  {32.0, 8.4, kGully},  {56.0, 8.4, kBump}, {54.0, 25.0, kGully},
                {48.0, 25.0, kBump}, {30.0, 41.6, kGully}, {18.0, 41.6, kBump}};
  return plan;
}

// parking2: the ramps run side by side south of the halls, from x = kWest to x = kEast.
constexpr double kWest = 14.0, kEast = 51.0, kStoreyHeight = 3.2;
constexpr Ramp kDown = {kWest - 3.0, kEast + 3.0, -3.25, 0.0, -kStoreyHeight};
constexpr Ramp kUp = {kWest - 3.0, kEast + 3.0, -8.75, -kStoreyHeight, 0.0};

StoreyPlan parking2_plan() {
  StoreyPlan plan = hall(65.0);
  plan.cross_aisles = {kWest, kEast};
  plan.bay_blocks = {{0.5, 4}, {17.5, 12}, {54.5, 4}};
  plan.cores = {{{1.6, 25.0}, {3.2, 6.0}}, {{63.2, 25.0}, {3.6, 5.0}}};
  plan.openings = {{{kWest, 0.0}, Ramp::kLanding}, {{kEast, 0.0}, Ramp::kLanding}};
  plan.bumps = {{22.0, 8.4, kBump},  {31.0, 8.4, kGully},  {42.0, 8.4, kBump},
                {26.0, 25.0, kBump}, {40.0, 25.0, kGully}, {32.0, 41.6, kBump}};
  return plan;
}

Mesh parking2_mesh(std::uint64_t seed) {
  Mesh mesh;
  for (const std::uint64_t storey : {0, 1}) {
    Random building(seed), cars(hash(seed, 2, storey));
    Mesh part;
    add_storey(part, parking2_plan(), building, cars);
    add_mesh(mesh, part, {0.0, 0.0, -kStoreyHeight * static_cast<double>(storey)});
  }
  for (const Ramp& ramp : {kDown, kUp}) {
    add_ramp(mesh, ramp, kCeiling);
    const double side = ramp.y + 0.5 * Ramp::kWidth;
    add_passage(mesh, kWest, 0.0, side, ramp.z_begin, kCeiling);
    add_passage(mesh, kEast, 0.0, side, ramp.z_end, kCeiling);
  }
  return mesh;
}

// The distance (m) at which the route first comes to a place that lies on it, after `from`.
double passage(const Route& route, const Vector2d& place, double from) {
  while ((route.at(from).position - place).norm() > 0.2) from += 0.1;
  return from;
}

// Along the aisle, down, along the same aisle below, up. The ground changes in the passages, where
// the halls and the ramps are level.
Drive parking2_drive(const DriveSettings& settings) {
  const Vector2d start(36.0, 8.4);
  std::vector<Vector2d> waypoints = {start};
  std::vector<Vector2d> passages;
  for (const Ramp& ramp : {kDown, kUp}) {
    waypoints.insert(waypoints.end(),
                     {{kWest, 8.4}, {kWest, ramp.y}, {kEast, ramp.y}, {kEast, 8.4}});
    passages.insert(passages.end(), {{kWest, 0.0}, {kEast, 0.0}});
  }
  waypoints.push_back(start);
  const Route route(waypoints, 3.0);

  const auto floor = [plan = parking2_plan()](double x, double y) {
    return floor_height(plan, x, y);
  };
  const auto floor_below = [floor](double x, double y) { return floor(x, y) - kStoreyHeight; };
  const auto way_down = [](double x, double) { return kDown.height(x); };
  const auto way_up = [](double x, double) { return kUp.height(x); };
  const std::vector<Ground> grounds = {floor, way_down, floor_below, way_up, floor};
  std::vector<GroundSection> sections;
  double distance = 0.0;
  for (std::size_t i = 0; i < grounds.size(); ++i) {
    if (i > 0) distance = passage(route, passages[i - 1], distance);
    sections.push_back({distance, grounds[i]});
  }
  return {route, sections, settings};
}

Mesh one_storey(const StoreyPlan& plan, std::uint64_t seed) {
  Mesh mesh;
  Random random(seed);
  add_storey(mesh, plan, random, random);
  return mesh;
}

Drive drive_on(const StoreyPlan& plan, const std::vector<Vector2d>& waypoints, double corner_radius,
               const DriveSettings& settings) {
  return {Route(waypoints, corner_radius),
          [plan](double x, double y) { return floor_height(plan, x, y); }, settings};
}

DriveSettings vehicle(double speed, std::uint64_t seed) {
  return {.speed = speed,
          .acceleration = 0.4,
          .lateral_acceleration = 0.4,
          .wheel_base = 1.2,
          .track_width = 0.9,
          .shaking = {.roll_deg = 0.5, .pitch_deg = 0.5, .yaw_deg = 0.25, .z = 0.008},
          .seed = hash(seed, 1)};
}

World world_of(Mesh mesh, Drive drive) {
  return {.sensor = "rs16",
          .sensor_height = kSensorHeight,
          .mesh = std::move(mesh),
          .motion = motion_of(std::move(drive))};
}

Pose at(double x, double y, double yaw_deg) {
  return Eigen::Translation3d(x, y, 0.0) * Eigen::AngleAxisd(radians(yaw_deg), Vector3d::UnitZ());
}

}  // namespace

World make_parking(std::uint64_t seed) {
  const StoreyPlan plan = parking_plan();
  Mesh mesh = one_storey(plan, seed);
  add_entrance(mesh, at(80.0, 25.0, 0.0));
  const std::vector<Vector2d> waypoints = {{18.0, 25.0}, {73.0, 25.0}, {73.0, 41.6}, {7.0, 41.6},
                                           {7.0, 25.0},  {40.0, 25.0}, {40.0, 8.4},  {7.0, 8.4},
                                           {7.0, 25.0},  {18.0, 25.0}};
  return world_of(std::move(mesh), drive_on(plan, waypoints, 4.0, vehicle(1.5, seed)));
}

World make_parking1(std::uint64_t seed) {
  const StoreyPlan plan = parking1_plan();
  Mesh mesh = one_storey(plan, seed);
  add_entrance(mesh, at(0.0, 25.0, 180.0));
  add_entrance(mesh, at(76.0, 8.4, 0.0));
  const std::vector<Vector2d> waypoints = {{7.0, 28.0},  {7.0, 8.4},   {69.0, 8.4}, {69.0, 25.0},
                                           {38.0, 25.0}, {38.0, 41.6}, {7.0, 41.6}, {7.0, 28.0}};
  return world_of(std::move(mesh), drive_on(plan, waypoints, 3.5, vehicle(1.0, seed)));
}

World make_parking2(std::uint64_t seed) {
  return world_of(parking2_mesh(seed), parking2_drive(vehicle(1.0, seed)));
}

}  // namespace lego_loam_sc
