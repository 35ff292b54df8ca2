// SPDX-License-Identifier: BSD-3-Clause
#include "sim/storey.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/concrete.hpp"
#include "sim/materials.hpp"
#include "sim/props.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBayWidth = 2.5;                      // m
constexpr double kBumpAlong = 0.4, kBumpAcross = 2.6;  // m; half extents
constexpr double kRubber = 0.1, kPaint = 0.7;          // reflectivity

Pose place(double x, double y, double z = 0.0, double yaw_deg = 0.0) {
  return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(radians(yaw_deg), Vector3d::UnitZ());
}

double hump(double offset, double half_extent) {
  if (std::abs(offset) >= half_extent) return 0.0;
  return 0.5 + 0.5 * std::cos(std::numbers::pi * offset / half_extent);
}

bool covers(const Bump& bump, double x, double y) {
  return std::abs(x - bump.x) < kBumpAlong && std::abs(y - bump.y) < kBumpAcross;
}

std::vector<double> sorted(std::vector<double> values) {
  std::ranges::sort(values);
  const auto repeated = std::ranges::unique(values);
  values.erase(repeated.begin(), repeated.end());
  return values;
}

// Flat pieces round the rectangles of the bumps, out to the farthest parts of the walls.
void add_floor(Mesh& mesh, const StoreyPlan& plan) {
  std::vector<double> xs = {-kSetback, plan.length + kSetback};
  std::vector<double> ys = {-kSetback, plan.width + kSetback};
  for (const Bump& b : plan.bumps) {
    xs.insert(xs.end(), {b.x - kBumpAlong, b.x + kBumpAlong});
    ys.insert(ys.end(), {b.y - kBumpAcross, b.y + kBumpAcross});
    add_height_field(
        mesh, [&](double x, double y) { return floor_height(plan, x, y); },
        {b.x - kBumpAlong, b.y - kBumpAcross}, {b.x + kBumpAlong, b.y + kBumpAcross}, 0.1, 0.0,
        b.height > 0.0 ? kRubber : kSteel);
  }
  xs = sorted(xs);
  ys = sorted(ys);
  for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
    for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
      const double x = 0.5 * (xs[i] + xs[i + 1]), y = 0.5 * (ys[j] + ys[j + 1]);
      if (std::ranges::any_of(plan.bumps, [&](const Bump& b) { return covers(b, x, y); })) continue;
      add_quad(mesh,
               {Vector3d(xs[i], ys[j], 0), Vector3d(xs[i + 1], ys[j], 0),
                Vector3d(xs[i + 1], ys[j + 1], 0), Vector3d(xs[i], ys[j + 1], 0)},
               kAsphalt);
    }
  }
}

void add_ceiling(Mesh& mesh, const StoreyPlan& plan) {
  const Vector2d size(plan.length + 2.0 * kSetback, plan.width + 2.0 * kSetback);
  add_box(mesh, place(0.5 * plan.length, 0.5 * plan.width, kCeiling), {size.x(), size.y(), 0.1},
          kConcrete);
  for (double x = 3.75; x < plan.length; x += 7.5)
    add_box(mesh, place(x, 0.5 * plan.width, kCeiling - 0.4), {0.35, plan.width, 0.4}, kConcrete);
}

// The four outer walls, counter-clockwise, each in the pieces that the openings leave.
void add_walls(Mesh& mesh, const StoreyPlan& plan, Random& random) {
  const std::array<Vector2d, 4> corners = {Vector2d(0, 0), Vector2d(plan.length, 0),
                                           Vector2d(plan.length, plan.width),
                                           Vector2d(0, plan.width)};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d& end = corners[(i + 1) % corners.size()];
    const Vector2d along = (end - corners[i]).normalized();
    std::vector<std::pair<double, double>> gaps;
    for (const Opening& opening : plan.openings) {
      const Vector2d offset = opening.middle - corners[i];
      const double distance = offset.dot(along);
      if ((offset - distance * along).norm() < 0.01)
        gaps.emplace_back(distance - 0.5 * opening.width, distance + 0.5 * opening.width);
    }
    std::ranges::sort(gaps);
    Vector2d start = corners[i];
    for (const auto& [from, to] : gaps) {
      add_wall(mesh, start, corners[i] + from * along, kCeiling, random);
      start = corners[i] + to * along;
    }
    add_wall(mesh, start, end, kCeiling, random);
  }
}

void add_cores(Mesh& mesh, const StoreyPlan& plan) {
  for (const auto& [middle, size] : plan.cores) {
    add_box(mesh, place(middle.x(), middle.y()), {size.x(), size.y(), kCeiling}, kConcrete);
    const double side = middle.x() < 0.5 * plan.length ? 1.0 : -1.0;
    const double face = middle.x() + side * (0.5 * size.x() + 0.02);
    add_box(mesh, place(face, middle.y() + 1.5), {0.06, 1.1, 2.1}, kPaint);
  }
}

void add_parked_cars(Mesh& mesh, const StoreyPlan& plan, Random& random) {
  for (const double row : plan.bay_rows) {
    for (const BayBlock& block : plan.bay_blocks) {
      for (int bay = 0; bay < block.bays; ++bay) {
        if (random.chance(0.25)) continue;
        const double x = block.start + (bay + 0.5) * kBayWidth + random.uniform(-0.15, 0.15);
        const double heading = random.chance(0.5) ? 90.0 : -90.0;
        const double yaw = heading + random.uniform(-3.0, 3.0);
        add_car(mesh, place(x, row + random.uniform(-0.25, 0.25), 0.0, yaw), random);
      }
    }
  }
}

void add_columns(Mesh& mesh, const StoreyPlan& plan) {
  for (const BayBlock& block : plan.bay_blocks) {
    for (int bay = 0; bay <= block.bays; bay += 2) {
      const double x = block.start + bay * kBayWidth;
      for (const double y : plan.square_columns) {
        add_box(mesh, place(x, y), {0.4, 0.4, kCeiling}, kConcrete);
        add_box(mesh, place(x, y), {0.44, 0.44, 1.0}, kPaint);  // an edge guard
      }
      for (const double y : plan.round_columns)
        add_cylinder(mesh, place(x, y), 0.16, kCeiling, kConcrete);
    }
  }
}

void add_pipes_and_lamps(Mesh& mesh, const StoreyPlan& plan, Random& random) {
  for (const double aisle : plan.aisles) {
    for (const auto& [offset, radius] : {std::pair(-2.2, 0.08), std::pair(1.9, 0.05)}) {
      Pose pipe = place(0.0, aisle + offset, 2.3);
      pipe.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitY()));
      add_cylinder(mesh, pipe, radius, plan.length, kSteel);
    }
    for (double x = 6.0; x < plan.length; x += 6.0)
      add_box(mesh, place(x + random.uniform(-0.5, 0.5), aisle, kCeiling - 0.2), {1.5, 0.15, 0.1},
              kPaint);
  }
}

// Bollards at the corners of the inner rows; ticket pillars and signs beside the cross aisles.
void add_corners(Mesh& mesh, const StoreyPlan& plan, Random& random) {
  std::vector<double> rows;
  for (const double aisle : plan.aisles) rows.insert(rows.end(), {aisle - 3.6, aisle + 3.6});
  for (const double cross : plan.cross_aisles) {
    for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
      add_cylinder(mesh, place(cross - 3.0, rows[i]), 0.08, 1.0, kPaint);
      if (random.chance(0.5)) add_box(mesh, place(cross + 3.1, rows[i]), {0.35, 0.3, 1.4}, kSteel);
      add_box(mesh, place(cross + random.uniform(-1.0, 1.0), rows[i], 2.1), {1.0, 0.08, 0.3},
              kPaint);
    }
  }
}

}  // namespace

double floor_height(const StoreyPlan& plan, double x, double y) {
  const double shoulder = 0.5;
  double height = 0.0;
  for (const Bump& b : plan.bumps) {
    const double beside = std::max(0.0, std::abs(y - b.y) - (kBumpAcross - shoulder));
    height += b.height * hump(x - b.x, kBumpAlong) * hump(beside, shoulder);
  }
  return height;
}

void add_storey(Mesh& mesh, const StoreyPlan& plan, Random& building, Random& cars) {
  add_floor(mesh, plan);
  add_ceiling(mesh, plan);
  add_walls(mesh, plan, building);
  add_cores(mesh, plan);
  add_parked_cars(mesh, plan, cars);
  add_columns(mesh, plan);
  add_pipes_and_lamps(mesh, plan, building);
  add_corners(mesh, plan, building);
}

}  // namespace lego_loam_sc
