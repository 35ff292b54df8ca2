// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/drive.hpp"
#include "sim/facade.hpp"
#include "sim/materials.hpp"
#include "sim/places.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The plan is a grid of streets, m; `bend` turns it into the world. The outermost lines are the
// edge of the town.
constexpr std::array<double, 5> kGridX = {-60.0, 0.0, 160.0, 300.0, 360.0};
constexpr std::array<double, 5> kGridY = {-60.0, 0.0, 110.0, 230.0, 290.0};
constexpr double kRoad = 5.0;                    // m from the middle of the street to the kerb
constexpr double kPavement = 2.6;                // m from the kerb to the houses
constexpr double kKerb = 0.13;                   // m
constexpr double kStone = 0.35, kPlaster = 0.5;  // reflectivity

Vector2d bend(const Vector2d& p) {
  return {p.x() + 7.0 * std::sin(p.y() / 55.0), p.y() + 9.0 * std::sin(p.x() / 60.0)};
}

double terrain(double x, double y) {
  return 1.6 * std::sin(x / 80.0) + 1.3 * std::cos(y / 65.0) + 0.15 * std::sin((x + y) / 17.0);
}

// A place of the plan in the world, on the ground; x of the result along `direction` of the plan.
Pose place(const Vector2d& p, const Vector2d& direction) {
  const Vector2d here = bend(p);
  const Vector2d along = bend(p + direction) - bend(p - direction);
  return Eigen::Translation3d(here.x(), here.y(), terrain(here.x(), here.y())) *
         Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Vector3d::UnitZ());
}

// One edge of a block along a street: x along the kerb, y into the block.
struct Frontage {
  Vector2d corner, along, inward;
  double length;

  Pose at(double x, double y, double z = 0.0) const {
    return place(corner + x * along + y * inward, along) * Eigen::Translation3d(0.0, 0.0, z);
  }
};

void add_pavement(Mesh& mesh, const Frontage& f) {
  const int pieces = static_cast<int>(std::ceil(f.length / 4.0));
  const auto edge = [&](double x, double y, double z) -> Vector3d {
    // Mitred at the corners of the block, where two frontages meet.
    const double mitred = std::clamp(x, y, f.length - y);
    return f.at(mitred, y, z).translation();
  };
  for (int i = 0; i < pieces; ++i) {
    const double x0 = f.length * i / pieces, x1 = f.length * (i + 1) / pieces;
    add_quad(mesh, {edge(x0, 0, 0), edge(x1, 0, 0), edge(x1, 0, kKerb), edge(x0, 0, kKerb)},
             kStone);
    add_quad(mesh,
             {edge(x0, 0, kKerb), edge(x1, 0, kKerb), edge(x1, 7.0, kKerb), edge(x0, 7.0, kKerb)},
             kStone);
  }
}

// What stands in front of a house that stands back, or closes a gap between two.
void add_garden_edge(Mesh& mesh, const Frontage& f, double middle, double length, Random& random) {
  const Pose place_of_edge = f.at(middle, kPavement + 0.3, kKerb);
  if (random.chance(0.5))
    add_hedge(mesh, place_of_edge, length, random);
  else
    add_box(mesh, place_of_edge * Eigen::Translation3d(0.0, 0.0, -0.5),
            {length, 0.25, 0.5 + random.uniform(0.6, 1.8)}, kPlaster);
}

void add_houses(Mesh& mesh, const Frontage& f, double margin, Random& random) {
  double x = margin;
  while (x + 8.0 < f.length - margin) {
    const House house{.width = std::min(random.uniform(8.0, 17.0), f.length - margin - x),
                      .depth = random.uniform(9.0, 12.0),
                      .storeys = random.chance(0.5) ? 2 : 3};
    const bool garden = random.chance(0.3);
    const double setback =
        kPavement + (garden ? random.uniform(2.5, 4.5) : random.uniform(0.0, 0.6));
    const double middle = x + 0.5 * house.width;
    add_house(mesh, f.at(middle, setback, kKerb), house, random);
    if (garden) add_garden_edge(mesh, f, middle - 1.0, house.width - 2.0, random);
    x += house.width;
    if (random.chance(0.4)) {
      const double gap = random.uniform(2.0, 7.0);
      if (random.chance(0.7)) add_garden_edge(mesh, f, x + 0.5 * gap, gap, random);
      x += gap;
    }
  }
}

void add_street_furniture(Mesh& mesh, const Frontage& f, Random& random) {
  for (double x = 12.0; x < f.length - 12.0; x += 6.3) {
    if (random.chance(0.45)) {
      const Vector2d spot{x + random.uniform(-0.4, 0.4), -1.1 + random.uniform(-0.1, 0.1)};
      add_car(mesh, f.at(spot.x(), spot.y()), random);
    }
    if (random.chance(0.25)) add_tree(mesh, f.at(x + 3.0, 0.7, kKerb), random);
  }
  const auto facing_street = Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vector3d::UnitZ());
  for (double x = 9.0; x < f.length; x += 28.0)
    add_lamp(mesh, f.at(x + random.uniform(-2.0, 2.0), 0.4, kKerb) * facing_street);
  add_sign(mesh, f.at(4.0, 0.5, kKerb));
  add_sign(mesh, f.at(f.length - random.uniform(5.0, 20.0), 0.5, kKerb));
}

// The four frontages of the block between two corners of the grid, counter-clockwise.
std::array<Frontage, 4> frontages(const Vector2d& low, const Vector2d& high) {
  const Vector2d x = Vector2d::UnitX(), y = Vector2d::UnitY();
  const Vector2d size = high - low;
  return {{{low, x, y, size.x()},
           {{high.x(), low.y()}, y, -x, size.y()},
           {high, -x, -y, size.x()},
           {{low.x(), high.y()}, -y, x, size.y()}}};
}

Mesh make_mesh(std::uint64_t seed) {
  Mesh mesh;
  add_height_field(mesh, terrain, {-130.0, -130.0}, {430.0, 360.0}, 2.0, 0.0, kAsphalt);
  for (std::size_t i = 0; i + 1 < kGridX.size(); ++i) {
    for (std::size_t j = 0; j + 1 < kGridY.size(); ++j) {
      const Vector2d low(kGridX[i] + kRoad, kGridY[j] + kRoad);
      const Vector2d high(kGridX[i + 1] - kRoad, kGridY[j + 1] - kRoad);
      Random random(hash(seed, i, j));
      for (const Frontage& f : frontages(low, high)) {
        // The houses along x also make the corners.
        const double margin = f.along.y() == 0.0 ? kPavement + 0.5 : 18.0;
        add_pavement(mesh, f);
        add_houses(mesh, f, margin, random);
        add_street_furniture(mesh, f, random);
      }
    }
  }
  return mesh;
}

// Bent legs from crossing to crossing; near a crossing the leg is left to the rounded corner.
std::vector<Vector2d> make_waypoints() {
  const std::array<Vector2d, 8> crossings = {
      Vector2d(30, 0),    Vector2d(300, 0), Vector2d(300, 230), Vector2d(160, 230),
      Vector2d(160, 110), Vector2d(0, 110), Vector2d(0, 0),     Vector2d(100, 0)};
  std::vector<Vector2d> waypoints = {bend(crossings.front())};
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const Vector2d leg = crossings[i] - crossings[i - 1];
    const int pieces = static_cast<int>(leg.norm() / 25.0);
    for (int piece = 1; piece <= pieces; ++piece)
      waypoints.push_back(bend(crossings[i - 1] + leg * piece / pieces));
  }
  return waypoints;
}

}  // namespace

World make_street(std::uint64_t seed) {
  const DriveSettings settings{
      .speed = 9.0,
      .acceleration = 1.5,
      .lateral_acceleration = 2.5,
      .wheel_base = 2.7,
      .track_width = 1.6,
      .shaking = {.roll_deg = 0.1, .pitch_deg = 0.12, .yaw_deg = 0.03, .z = 0.008},
      .seed = hash(seed, 1)};
  return {.sensor = "hdl64e",
          .sensor_height = 1.73,
          .mesh = make_mesh(seed),
          .motion = motion_of(Drive(Route(make_waypoints(), 9.0), terrain, settings))};
}

}  // namespace lego_loam_sc
