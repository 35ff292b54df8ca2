// SPDX-License-Identifier: BSD-3-Clause
#include "sim/props.hpp"

#include <cmath>
#include <numbers>

#include "sim/materials.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr double kRubber = 0.05, kBark = 0.25, kLeaf = 0.45, kSign = 0.9;  // reflectivities

Pose at(const Pose& base, double x, double y, double z) {
  return base * Eigen::Translation3d(x, y, z);
}

void add_wheel(Mesh& mesh, const Pose& T_world_hub) {
  const double width = 0.22;
  Pose axle = T_world_hub;  // z of the cylinder along y of the car
  axle.rotate(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vector3d::UnitX()));
  axle.translate(Vector3d(0.0, 0.0, -0.5 * width));
  add_cylinder(mesh, axle, 0.31, width, kRubber);
}

// Leaves as small squares at random within an ellipsoid or box: like real foliage they return a
// scattered surface, and some rays pass.
void add_leaf(Mesh& mesh, const Vector3d& centre, double size, Random& random) {
  const Vector3d normal{random.gaussian(), random.gaussian(), random.gaussian()};
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  const Vector3d a = turn * Vector3d(0.5 * size, 0.0, 0.0);
  const Vector3d b = turn * Vector3d(0.0, 0.5 * size, 0.0);
  add_quad(mesh, {centre - a - b, centre + a - b, centre + a + b, centre - a + b}, kLeaf);
}

}  // namespace

void add_car(Mesh& mesh, const Pose& T_world_car, Random& random) {
  const bool van = random.chance(0.15);
  const double front = 0.5 * random.uniform(van ? 4.6 : 3.8, van ? 5.0 : 4.7);
  const double half_width = random.uniform(0.84, 0.94);
  const double belt = van ? 1.05 : random.uniform(0.82, 0.92);  // m; lower edge of the windows
  const double roof = van ? random.uniform(1.85, 2.0) : random.uniform(1.40, 1.52);
  const double paint = random.uniform(0.08, 0.7);
  const double bonnet = van ? 0.7 : random.uniform(0.95, 1.2);
  const double boot = random.chance(0.5) ? 0.15 : random.uniform(0.5, 0.8);

  add_frustum(mesh, T_world_car, {-front + 0.1, front - 0.1, half_width - 0.06, 0.2},
              {-front, front, half_width, 0.5}, paint, paint);
  add_frustum(mesh, T_world_car, {-front, front, half_width, 0.5},
              {-front + 0.08, front - 0.25, half_width - 0.04, belt}, paint, paint);
  add_frustum(mesh, T_world_car, {-front + boot, front - bonnet, half_width - 0.06, belt},
              {-front + boot + 0.3, front - bonnet - (van ? 0.4 : 0.7), half_width - 0.25, roof},
              kGlass, paint);
  for (const double x : {-front + 0.75, front - 0.8})
    for (const double y : {-half_width + 0.11, half_width - 0.11})
      add_wheel(mesh, at(T_world_car, x, y, 0.31));
}

void add_tree(Mesh& mesh, const Pose& T_world_tree, Random& random) {
  const double clear = random.uniform(1.9, 2.8);  // m below the crown
  const double radius = random.uniform(1.2, 2.2);
  const double half_height = random.uniform(1.5, 3.0);
  add_cylinder(mesh, at(T_world_tree, 0.0, 0.0, -0.1), random.uniform(0.09, 0.2),
               clear + half_height, kBark);
  for (int i = 0; i < 250; ++i) {
    Vector3d inside{random.gaussian(), random.gaussian(), random.gaussian()};
    inside *= std::cbrt(random.uniform(0.3, 1.0)) / inside.norm();
    const Vector3d centre = inside.cwiseProduct(Vector3d(radius, radius, half_height)) +
                            Vector3d(0.0, 0.0, clear + half_height);
    add_leaf(mesh, T_world_tree * centre, 0.3, random);
  }
}

void add_hedge(Mesh& mesh, const Pose& T_world_hedge, double length, Random& random) {
  const double height = random.uniform(0.9, 1.7);
  const double width = 0.7;
  add_box(mesh, at(T_world_hedge, 0.0, 0.0, -0.2), {length, 0.5 * width, height}, kLeaf);
  const int leaves = static_cast<int>(60.0 * length);
  for (int i = 0; i < leaves; ++i) {
    const Vector3d centre{random.uniform(-0.5, 0.5) * length, random.uniform(-0.5, 0.5) * width,
                          random.uniform(0.0, 1.0) * height};
    add_leaf(mesh, T_world_hedge * centre, 0.18, random);
  }
}

void add_lamp(Mesh& mesh, const Pose& T_world_lamp) {
  add_cylinder(mesh, at(T_world_lamp, 0.0, 0.0, -0.1), 0.08, 6.1, kSteel);
  add_cylinder(mesh, at(T_world_lamp, 0.0, 0.0, -0.1), 0.13, 1.1, kSteel);
  add_box(mesh, at(T_world_lamp, 0.6, 0.0, 5.9), {1.4, 0.15, 0.12}, kSteel);
}

void add_sign(Mesh& mesh, const Pose& T_world_sign) {
  add_cylinder(mesh, at(T_world_sign, 0.0, 0.0, -0.1), 0.04, 2.6, kSteel);
  add_box(mesh, at(T_world_sign, 0.06, 0.0, 1.9), {0.02, 0.6, 0.6}, kSign);
}

}  // namespace lego_loam_sc
