// SPDX-License-Identifier: BSD-3-Clause
#include "sim/concrete.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/materials.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPaint = 0.7;  // reflectivity

}  // namespace

void add_wall(Mesh& mesh, const Vector2d& start, const Vector2d& end, double height,
              Random& random) {
  const Vector2d along = (end - start).normalized();
  const Pose wall = Eigen::Translation3d(start.x(), start.y(), 0.0) *
                    Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Vector3d::UnitZ());
  const auto panel = [&](double xa, double ya, double xb, double yb, double reflectivity) {
    add_quad(mesh,
             {wall * Vector3d(xa, ya, 0), wall * Vector3d(xb, yb, 0),
              wall * Vector3d(xb, yb, height), wall * Vector3d(xa, ya, height)},
             reflectivity);
  };
  const double total = (end - start).norm();
  double x = 0.0;
  double setback = 0.0;
  while (x < total) {
    const bool is_door = random.chance(0.2);
    const double next = std::min(total, x + (is_door ? 1.2 : random.uniform(2.5, 6.0)));
    double next_setback = kSetback;
    if (!is_door) next_setback = random.chance(0.5) ? 0.0 : 0.15;
    panel(x, -setback, x, -next_setback, kConcrete);
    panel(x, -next_setback, next, -next_setback, is_door ? kPaint : kConcrete);
    if (!is_door && random.chance(0.4))
      add_box(mesh, wall * Eigen::Translation3d(x, 0.05, 0.0), {0.4, 0.5, height}, kConcrete);
    if (!is_door && random.chance(0.2))
      add_box(mesh, wall * Eigen::Translation3d(0.5 * (x + next), 0.15, 0.6), {0.8, 0.3, 1.1},
              kSteel);
    x = next;
    setback = next_setback;
  }
  panel(total, -setback, total, 0.0, kConcrete);
}

void add_entrance(Mesh& mesh, const Pose& T_world_foot) {
  const double length = 16.0, half_width = 3.0, rise = 2.8, wall_height = 6.0;
  const auto at = [&](double x, double y, double z) -> Pose {
    return T_world_foot * Eigen::Translation3d(x, y, z);
  };
  const auto corner = [&](double x, double y, double z) -> Vector3d {
    return T_world_foot * Vector3d(x, y, z);
  };
  add_quad(mesh,
           {corner(0, -half_width, 0), corner(length, -half_width, rise),
            corner(length, half_width, rise), corner(0, half_width, 0)},
           kAsphalt);
  for (const double y : {-half_width, half_width}) {
    add_box(mesh, at(0.5 * length, y, 0), {length, 0.3, wall_height}, kConcrete);
    add_box(mesh, at(3.0, y, 0.8), {6.0, 0.4, 0.15}, kSteel);  // a crash rail
  }
  add_box(mesh, at(length, 0, 0), {0.3, 2.0 * half_width, wall_height}, kSteel);
}

double Ramp::height(double x) const {
  // Parabolic roundings of 3 m between the landings and the slope, as roads have.
  const double rounding = 3.0;
  const double run = x_end - x_begin - 2.0 * kLanding;
  const double grade = (z_end - z_begin) / (run - rounding);
  const double u = std::clamp(x - x_begin - kLanding, 0.0, run);
  if (u < rounding) return z_begin + 0.5 * grade * u * u / rounding;
  if (u > run - rounding) return z_end - 0.5 * grade * (run - u) * (run - u) / rounding;
  return z_begin + grade * (u - 0.5 * rounding);
}

void add_ramp(Mesh& mesh, const Ramp& ramp, double clear_height) {
  const double y_low = ramp.y - 0.5 * Ramp::kWidth, y_high = ramp.y + 0.5 * Ramp::kWidth;
  const auto wall = [&](double xa, double ya, double xb, double yb) {
    const double za = ramp.height(xa), zb = ramp.height(xb);
    add_quad(mesh,
             {Vector3d(xa, ya, za), Vector3d(xb, yb, zb), Vector3d(xb, yb, zb + clear_height),
              Vector3d(xa, ya, za + clear_height)},
             kConcrete);
  };
  // The way, the ceiling and the closed side between two places.
  const auto slab = [&](double xa, double xb) {
    const double za = ramp.height(xa), zb = ramp.height(xb);
    for (const auto& [above, reflectivity] :
         {std::pair(0.0, kAsphalt), std::pair(clear_height, kConcrete)})
      add_quad(mesh,
               {Vector3d(xa, y_low, za + above), Vector3d(xb, y_low, zb + above),
                Vector3d(xb, y_high, zb + above), Vector3d(xa, y_high, za + above)},
               reflectivity);
    wall(xa, y_low, xb, y_low);
  };
  const double slope_begin = ramp.x_begin + Ramp::kLanding, slope_end = ramp.x_end - Ramp::kLanding;
  const int pieces = static_cast<int>(std::ceil((slope_end - slope_begin) / 0.25));
  slab(ramp.x_begin, slope_begin);
  for (int i = 0; i < pieces; ++i) {
    const double xa = slope_begin + (slope_end - slope_begin) * i / pieces;
    const double xb = slope_begin + (slope_end - slope_begin) * (i + 1) / pieces;
    slab(xa, xb);
    wall(xa, y_high, xb, y_high);
  }
  slab(slope_end, ramp.x_end);
  for (const double x : {ramp.x_begin, ramp.x_end}) wall(x, y_low, x, y_high);
  // Concrete frames hold the shaft.
  for (double x = slope_begin; x <= slope_end; x += 5.0) {
    const Pose floor(Eigen::Translation3d(x, ramp.y, ramp.height(x)));
    add_box(mesh, floor * Eigen::Translation3d(0, 0, clear_height - 0.35),
            {0.3, Ramp::kWidth, 0.35}, kConcrete);
    for (const double side : {-0.5, 0.5})
      add_box(mesh, floor * Eigen::Translation3d(0, side * Ramp::kWidth, 0),
              {0.3, 0.3, clear_height}, kConcrete);
  }
}

void add_passage(Mesh& mesh, double x, double y_begin, double y_end, double z,
                 double clear_height) {
  const double low = x - 0.5 * Ramp::kLanding, high = x + 0.5 * Ramp::kLanding;
  const auto face = [&](double xa, double za, double xb, double zb, double reflectivity) {
    add_quad(mesh,
             {Vector3d(xa, y_begin, za), Vector3d(xb, y_begin, zb), Vector3d(xb, y_end, zb),
              Vector3d(xa, y_end, za)},
             reflectivity);
  };
  face(low, z, high, z, kAsphalt);
  face(low, z + clear_height, high, z + clear_height, kConcrete);
  for (const double side : {low, high}) face(side, z, side, z + clear_height, kConcrete);
}

}  // namespace lego_loam_sc
