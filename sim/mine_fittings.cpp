// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mine_fittings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/materials.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRust = 0.2, kRubber = 0.06, kTimber = 0.35, kPaint = 0.6,
                 kSpoil = 0.12;  // reflectivities
constexpr double kPiece = 3.0;   // m; pipes and belts come in straight pieces

// Where things stand along a wall, m beside the line: the rock reaches round some of them.
double clear_side(const Roadway& roadway, double distance) {
  return roadway.axis(distance).section.half_width - 0.25;
}

Pose beside(const Roadway& roadway, double distance, double left, double up = 0.0) {
  return roadway.at(distance) * Eigen::Translation3d(0.0, left, up);
}

}  // namespace

void add_pipes(Mesh& mesh, const Roadway& roadway, double from, double to) {
  struct Pipe {
    double up, radius;
  };
  for (const auto& [up, radius] : {Pipe{2.1, 0.1}, Pipe{1.8, 0.06}}) {
    const auto joint = [&](double distance) -> Vector3d {
      return beside(roadway, distance, -clear_side(roadway, distance), up).translation();
    };
    for (double x = from; x < to; x += kPiece) {
      const double next = std::min(x + kPiece, to);
      add_rod(mesh, joint(x), joint(next), radius, kRust);
      add_rod(mesh, joint(x) - Vector3d(0, 0, 0.06), joint(x) + Vector3d(0, 0, 0.06), radius + 0.06,
              kRust);  // the flange
    }
  }
}

void add_conveyor(Mesh& mesh, const Roadway& roadway, double from, double to) {
  const double right = -1.95;
  for (double x = from; x + kPiece <= to; x += kPiece) {
    // A piece is laid between its ends, so that it follows the slope.
    const Vector3d start = beside(roadway, x, right).translation();
    const Vector3d end = beside(roadway, x + kPiece, right).translation();
    Pose piece = Pose::Identity();
    piece.translation() = 0.5 * (start + end);
    const Vector3d along = (end - start).normalized();
    const Vector3d left = Vector3d::UnitZ().cross(along).normalized();
    piece.linear() << along, left, along.cross(left);
    const auto part = [&](const Vector3d& place, const Vector3d& size, double reflectivity) {
      add_box(mesh, piece * Eigen::Translation3d(place), size, reflectivity);
    };
    const double length = (end - start).norm();
    part({0, 0, 0.75}, {length, 0.7, 0.1}, kRubber);
    part({0, 0, 0.3}, {length, 0.6, 0.03}, kRubber);
    for (const double side : {-0.4, 0.4}) {
      part({0, side, 0.6}, {length, 0.05, 0.12}, kSteel);
      part({-0.5 * length, side, -0.1}, {0.08, 0.08, 0.75}, kSteel);
    }
  }
}

void add_steel_arches(Mesh& mesh, const Roadway& roadway, double from, double to, Random& random) {
  for (double x = from; x < to; x += 1.5) {
    const Roadway::Axis axis = roadway.axis(x + random.uniform(-0.15, 0.15));
    const Arch& arch = axis.section;
    const double inside = random.uniform(0.1, 0.25);  // m from where the rock was cut
    const auto on_arch = [&](double angle) -> Vector3d {
      const Vector2d outwards(std::cos(angle), std::sin(angle));
      return axis.at(arch.at(angle) - inside * outwards);
    };
    const int pieces = 8;
    for (int i = 0; i < pieces; ++i)
      add_rod(mesh, on_arch(std::numbers::pi * i / pieces),
              on_arch(std::numbers::pi * (i + 1) / pieces), 0.07, kRust);
    for (const double angle : {0.0, std::numbers::pi}) {
      const Vector3d top = on_arch(angle), down(0.0, 0.0, -arch.wall - 0.1);
      add_rod(mesh, top + down, top, 0.07, kRust);
    }
  }
}

void add_props(Mesh& mesh, const Roadway& roadway, double from, double to, Random& random) {
  for (const double side : {-1.0, 1.0}) {
    for (double x = from; x < to; x += random.uniform(1.6, 4.0)) {
      const double left = side * (clear_side(roadway, x) - random.uniform(0.0, 0.35));
      const double radius = random.uniform(0.07, 0.12);
      add_cylinder(mesh, beside(roadway, x, left, -0.1), radius, 3.2, kTimber);
    }
  }
}

void add_clutter(Mesh& mesh, const Roadway& roadway, double from, double to, Random& random) {
  for (double x = from + random.uniform(0.0, 12.0); x < to; x += random.uniform(6.0, 22.0)) {
    const double side = clear_side(roadway, x);
    const double kind = random.uniform();
    if (kind < 0.35) {
      const Vector3d size{random.uniform(0.5, 1.4), 0.4, random.uniform(0.8, 1.6)};
      add_box(mesh, beside(roadway, x, side - 0.1), size, kPaint);
    } else if (kind < 0.7) {
      const double length = random.uniform(0.8, 2.5), height = random.uniform(0.3, 0.9);
      add_frustum(mesh, beside(roadway, x, side), {-length, length, 0.5, -0.1},
                  {-0.4 * length, 0.4 * length, 0.15, height}, kSpoil, kSpoil);
    } else {
      add_box(mesh, beside(roadway, x, random.uniform(-0.8, 0.8), 2.4), {0.05, 0.7, 0.4}, kPaint);
    }
  }
}

void add_loader(Mesh& mesh, const Pose& T_world_loader) {
  add_frustum(mesh, T_world_loader, {-2.2, 1.4, 0.9, 0.5}, {-2.2, 1.2, 0.8, 1.5}, kPaint, kPaint);
  add_frustum(mesh, T_world_loader, {-0.6, 0.6, 0.7, 1.5}, {-0.5, 0.4, 0.6, 2.1}, kPaint, kPaint);
  add_frustum(mesh, T_world_loader, {1.9, 3.2, 1.0, 0.05}, {1.7, 3.4, 1.1, 0.9}, kRust, kRust);
  for (const double x : {-1.5, 0.9}) {
    for (const double y : {-0.85, 0.85}) {
      const Vector3d hub(x, y, 0.55), half_width(0.0, 0.2, 0.0);
      add_rod(mesh, T_world_loader * Vector3d(hub - half_width),
              T_world_loader * Vector3d(hub + half_width), 0.55, kRubber);
    }
  }
}

}  // namespace lego_loam_sc
