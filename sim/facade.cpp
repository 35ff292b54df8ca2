// SPDX-License-Identifier: BSD-3-Clause
#include "sim/facade.hpp"

#include <algorithm>
#include <numbers>

#include "sim/materials.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr double kWood = 0.35;        // reflectivity
constexpr double kBelowGround = 0.8;  // m; no gap opens where the ground falls away

// What the walls of one house have in common.
struct Style {
  double plaster, storey_height, axis_distance, window_width, window_height, sill_height, recess;
  bool pilasters;
};

Style random_style(Random& random) {
  return {.plaster = random.uniform(0.25, 0.7),
          .storey_height = random.uniform(2.8, 3.4),
          .axis_distance = random.uniform(2.2, 3.4),
          .window_width = random.uniform(0.9, 1.4),
          .window_height = random.uniform(1.2, 1.6),
          .sill_height = random.uniform(0.8, 1.1),
          .recess = random.uniform(0.12, 0.3),
          .pilasters = random.chance(0.4)};
}

// A rectangle of a wall: along x, up z.
struct Rect {
  double x0, x1, z0, z1;
};

void add_wall_rect(Mesh& mesh, const Pose& wall, const Rect& r, double y, double reflectivity) {
  add_quad(mesh,
           {wall * Vector3d(r.x0, y, r.z0), wall * Vector3d(r.x1, y, r.z0),
            wall * Vector3d(r.x1, y, r.z1), wall * Vector3d(r.x0, y, r.z1)},
           reflectivity);
}

// The wall of a cell with an opening in it, the reveals, and what closes the opening.
void add_cell(Mesh& mesh, const Pose& wall, const Rect& cell, const Rect& opening,
              const Style& style, double filling) {
  add_wall_rect(mesh, wall, {cell.x0, opening.x0, cell.z0, cell.z1}, 0.0, style.plaster);
  add_wall_rect(mesh, wall, {opening.x1, cell.x1, cell.z0, cell.z1}, 0.0, style.plaster);
  add_wall_rect(mesh, wall, {opening.x0, opening.x1, cell.z0, opening.z0}, 0.0, style.plaster);
  add_wall_rect(mesh, wall, {opening.x0, opening.x1, opening.z1, cell.z1}, 0.0, style.plaster);
  const auto reveal = [&](double xa, double za, double xb, double zb) {
    add_quad(mesh,
             {wall * Vector3d(xa, 0.0, za), wall * Vector3d(xb, 0.0, zb),
              wall * Vector3d(xb, style.recess, zb), wall * Vector3d(xa, style.recess, za)},
             style.plaster);
  };
  reveal(opening.x0, opening.z0, opening.x1, opening.z0);
  reveal(opening.x0, opening.z1, opening.x1, opening.z1);
  reveal(opening.x0, opening.z0, opening.x0, opening.z1);
  reveal(opening.x1, opening.z0, opening.x1, opening.z1);
  add_wall_rect(mesh, wall, opening, style.recess, filling);
}

void add_sill(Mesh& mesh, const Pose& wall, const Rect& opening, const Style& style) {
  const double middle = 0.5 * (opening.x0 + opening.x1);
  add_box(mesh, wall * Eigen::Translation3d(middle, -0.04, opening.z0 - 0.06),
          {opening.x1 - opening.x0 + 0.2, 0.16, 0.06}, style.plaster);
}

// One wall from x = 0 to `width`, its outside towards -y.
void add_wall(Mesh& mesh, const Pose& wall, double width, int storeys, bool with_door,
              const Style& style, Random& random) {
  const int axes = std::max(1, static_cast<int>(width / style.axis_distance));
  const double pitch = width / axes;
  const int door_axis = static_cast<int>(random.uniform(0.0, axes));
  for (int storey = 0; storey < storeys; ++storey) {
    const double floor = storey * style.storey_height;
    for (int axis = 0; axis < axes; ++axis) {
      const Rect cell{axis * pitch, (axis + 1) * pitch, storey == 0 ? -kBelowGround : floor,
                      floor + style.storey_height};
      const double middle = 0.5 * (cell.x0 + cell.x1);
      const double half_width = 0.5 * style.window_width;
      if (storey == 0 && with_door && axis == door_axis) {
        add_cell(mesh, wall, cell, {middle - 0.55, middle + 0.55, 0.05, 2.2}, style, kWood);
        add_box(mesh, wall * Eigen::Translation3d(middle, -0.3, -kBelowGround),
                {1.6, 0.6, kBelowGround + 0.17}, style.plaster);
      } else {
        const Rect window{middle - half_width, middle + half_width, floor + style.sill_height,
                          floor + style.sill_height + style.window_height};
        add_cell(mesh, wall, cell, window, style, kGlass);
        add_sill(mesh, wall, window, style);
      }
    }
  }
  const double height = storeys * style.storey_height;
  for (int axis = 0; axis <= axes; axis += style.pilasters ? 1 : axes) {
    const Pose foot = wall * Eigen::Translation3d(axis * pitch, -0.08, -kBelowGround);
    if (style.pilasters)
      add_box(mesh, foot, {0.4, 0.24, kBelowGround + height}, style.plaster);
    else
      add_cylinder(mesh, foot, 0.06, kBelowGround + height, kSteel);  // a downpipe
  }
  add_box(mesh, wall * Eigen::Translation3d(0.5 * width, 0.0, -kBelowGround),
          {width, 0.1, kBelowGround + 0.4}, 0.6 * style.plaster);  // the plinth
  add_box(mesh, wall * Eigen::Translation3d(0.5 * width, 0.0, height), {width, 0.4, 0.5},
          style.plaster);  // the parapet
}

}  // namespace

void add_house(Mesh& mesh, const Pose& T_world_house, const House& house, Random& random) {
  const Style style = random_style(random);
  Pose corner = T_world_house * Eigen::Translation3d(-0.5 * house.width, 0.0, 0.0);
  for (int side = 0; side < 4; ++side) {
    const double length = side % 2 == 0 ? house.width : house.depth;
    add_wall(mesh, corner, length, house.storeys, side == 0, style, random);
    corner = corner * Eigen::Translation3d(length, 0.0, 0.0) *
             Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitZ());
  }
  add_box(mesh,
          T_world_house *
              Eigen::Translation3d(0.0, 0.5 * house.depth, house.storeys * style.storey_height),
          {house.width, house.depth, 0.1}, style.plaster);
}

}  // namespace lego_loam_sc
