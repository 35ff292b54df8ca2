// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numbers>
#include <utility>

#include "sim/arch.hpp"
#include "sim/drive.hpp"
#include "sim/materials.hpp"
#include "sim/places.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr Arch kBore = {.half_width = 2.6, .wall = 2.0, .rise = 2.3};
constexpr double kNichesEnd = 15.0, kDriveEnd = 315.0;  // m from the start
constexpr double kBeyond = 250.0;                       // m of bore on either side of the drive
constexpr double kPiece = 5.0;  // m; triangles that are too slender spoil the ray caster's accuracy
constexpr double kPaint = 0.6;  // reflectivity

// A quadrilateral that two points of the section sweep along x.
void add_strip(Mesh& mesh, double x0, double x1, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
               double reflectivity) {
  for (double x = x0; x < x1; x += kPiece) {
    const double end = std::min(x + kPiece, x1);
    add_quad(mesh,
             {Vector3d(x, a.x(), a.y()), Vector3d(end, a.x(), a.y()), Vector3d(end, b.x(), b.y()),
              Vector3d(x, b.x(), b.y())},
             reflectivity);
  }
}

void add_floor_and_vault(Mesh& mesh) {
  const double x0 = -kBeyond, x1 = kDriveEnd + kBeyond;
  add_strip(mesh, x0, x1, {-kBore.half_width, 0.0}, {kBore.half_width, 0.0}, kAsphalt);
  const int pieces = 32;
  for (int i = 0; i < pieces; ++i)
    add_strip(mesh, x0, x1, kBore.at(std::numbers::pi * i / pieces),
              kBore.at(std::numbers::pi * (i + 1) / pieces), kConcrete);
}

// A niche as high as the wall, with a cabinet in it; `side` is 1 on the left, -1 on the right.
void add_niche(Mesh& mesh, double x0, double x1, double side, Random& random) {
  const double depth = random.uniform(0.8, 1.6);
  const double front = side * kBore.half_width, back = side * (kBore.half_width + depth);
  add_strip(mesh, x0, x1, {back, 0.0}, {back, kBore.wall}, kConcrete);
  for (const double z : {0.0, kBore.wall})
    add_strip(mesh, x0, x1, {front, z}, {back, z}, kConcrete);
  for (const double x : {x0, x1})
    add_quad(mesh,
             {Vector3d(x, front, 0), Vector3d(x, back, 0), Vector3d(x, back, kBore.wall),
              Vector3d(x, front, kBore.wall)},
             kConcrete);
  const Vector3d cabinet{random.uniform(0.4, 0.8), random.uniform(0.3, 0.6),
                         random.uniform(0.9, 1.7)};
  const double x = random.uniform(x0 + 0.5, x1 - 0.5);
  const double y = back - side * 0.5 * cabinet.y();
  add_box(mesh, Pose(Eigen::Translation3d(x, y, 0.0)), cabinet,
          random.chance(0.5) ? kPaint : kSteel);
}

void add_wall(Mesh& mesh, double side, Random& random) {
  const double y = side * kBore.half_width;
  double x = -kBeyond;
  const auto wall_up_to = [&](double end) {
    add_strip(mesh, x, end, {y, 0.0}, {y, kBore.wall}, kConcrete);
  };
  double niche = random.uniform(-6.0, -5.0);
  while (niche + 2.5 < kNichesEnd) {
    const double end = niche + random.uniform(1.2, 2.5);
    wall_up_to(niche);
    add_niche(mesh, niche, end, side, random);
    x = end;
    niche = end + random.uniform(1.0, 2.5);
  }
  wall_up_to(kDriveEnd + kBeyond);
}

Mesh make_mesh(std::uint64_t seed) {
  Mesh mesh;
  Random random(seed);
  add_floor_and_vault(mesh);
  for (const double side : {1.0, -1.0}) add_wall(mesh, side, random);
  return mesh;
}

Drive make_drive(std::uint64_t seed) {
  const DriveSettings settings{
      .speed = 2.0,
      .acceleration = 0.5,
      .wheel_base = 1.8,
      .track_width = 1.2,
      .shaking = {.roll_deg = 0.2, .pitch_deg = 0.2, .yaw_deg = 0.1, .z = 0.003},
      .seed = hash(seed, 1)};
  const auto flat = [](double, double) { return 0.0; };
  return {Route({{0.0, 0.0}, {kDriveEnd, 0.0}}, 1.0), flat, settings};
}

}  // namespace

World make_tunnel(std::uint64_t seed) {
  return {.sensor = "rs16",
          .sensor_height = 1.2,
          .mesh = make_mesh(seed),
          .motion = motion_of(make_drive(seed))};
}

}  // namespace lego_loam_sc
