// SPDX-License-Identifier: BSD-3-Clause
#include "sim/mesh.hpp"

#include <cmath>
#include <numbers>

namespace lego_loam_sc {
namespace {

// Enough for columns, poles and wheels at the resolution of a LiDAR.
constexpr int kCylinderSides = 12;

std::uint32_t add_vertex(Mesh& mesh, const Eigen::Vector3d& vertex) {
  mesh.vertices.emplace_back(vertex.cast<float>());
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                  double reflectivity) {
  mesh.triangles.push_back({a, b, c});
  mesh.reflectivity.push_back(static_cast<float>(reflectivity));
}

std::array<Eigen::Vector3d, 4> corners_of(const Pose& pose, const Slice& s) {
  return {pose * Eigen::Vector3d(s.rear, -s.half_width, s.z),
          pose * Eigen::Vector3d(s.front, -s.half_width, s.z),
          pose * Eigen::Vector3d(s.front, s.half_width, s.z),
          pose * Eigen::Vector3d(s.rear, s.half_width, s.z)};
}

}  // namespace

void add_quad(Mesh& mesh, const std::array<Eigen::Vector3d, 4>& corners, double reflectivity) {
  const std::uint32_t first = add_vertex(mesh, corners[0]);
  for (int i = 1; i < 4; ++i) add_vertex(mesh, corners[i]);
  add_triangle(mesh, first, first + 1, first + 2, reflectivity);
  add_triangle(mesh, first, first + 2, first + 3, reflectivity);
}

void add_box(Mesh& mesh, const Pose& T_world_box, const Eigen::Vector3d& size,
             double reflectivity) {
  const Slice bottom{-0.5 * size.x(), 0.5 * size.x(), 0.5 * size.y(), 0.0};
  Slice top = bottom;
  top.z = size.z();
  add_frustum(mesh, T_world_box, bottom, top, reflectivity, reflectivity);
}

void add_frustum(Mesh& mesh, const Pose& T_world_solid, const Slice& bottom, const Slice& top,
                 double side_reflectivity, double top_reflectivity) {
  const auto low = corners_of(T_world_solid, bottom);
  const auto high = corners_of(T_world_solid, top);
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    add_quad(mesh, {low[i], low[next], high[next], high[i]}, side_reflectivity);
  }
  add_quad(mesh, low, side_reflectivity);
  add_quad(mesh, high, top_reflectivity);
}

void add_cylinder(Mesh& mesh, const Pose& T_world_cylinder, double radius, double height,
                  double reflectivity) {
  const auto rim = [&](int side, double z) -> Eigen::Vector3d {
    const double angle = 2.0 * std::numbers::pi * side / kCylinderSides;
    return T_world_cylinder *
           Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
  };
  const std::uint32_t bottom = add_vertex(mesh, T_world_cylinder.translation());
  const std::uint32_t top = add_vertex(mesh, T_world_cylinder * Eigen::Vector3d(0.0, 0.0, height));
  for (int side = 0; side < kCylinderSides; ++side) {
    add_vertex(mesh, rim(side, 0.0));
    add_vertex(mesh, rim(side, height));
  }
  for (std::uint32_t side = 0; side < kCylinderSides; ++side) {
    const std::uint32_t low = top + 1 + 2 * side;
    const std::uint32_t next = top + 1 + 2 * ((side + 1) % kCylinderSides);
    add_triangle(mesh, low, next, next + 1, reflectivity);
    add_triangle(mesh, low, next + 1, low + 1, reflectivity);
    add_triangle(mesh, bottom, next, low, reflectivity);
    add_triangle(mesh, top, low + 1, next + 1, reflectivity);
  }
}

void add_rod(Mesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
             double reflectivity) {
  const Eigen::Vector3d axis = to - from;
  Pose pose = Pose::Identity();
  pose.translation() = from;
  pose.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
  add_cylinder(mesh, pose, radius, axis.norm(), reflectivity);
}

void add_mesh(Mesh& mesh, const Mesh& part, const Eigen::Vector3d& shift) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector3f& vertex : part.vertices)
    mesh.vertices.emplace_back(vertex + shift.cast<float>());
  for (const auto& [a, b, c] : part.triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
  mesh.reflectivity.insert(mesh.reflectivity.end(), part.reflectivity.begin(),
                           part.reflectivity.end());
}

void add_height_field(Mesh& mesh, const Ground& ground, const Eigen::Vector2d& low,
                      const Eigen::Vector2d& high, double spacing, double offset,
                      double reflectivity) {
  const Eigen::Vector2d size = high - low;
  const int nx = static_cast<int>(std::ceil(size.x() / spacing));
  const int ny = static_cast<int>(std::ceil(size.y() / spacing));
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i <= nx; ++i) {
    for (int j = 0; j <= ny; ++j) {
      const double x = low.x() + size.x() * i / nx;
      const double y = low.y() + size.y() * j / ny;
      add_vertex(mesh, {x, y, ground(x, y) + offset});
    }
  }
  const auto at = [&](int i, int j) {
    return first + static_cast<std::uint32_t>(i * (ny + 1) + j);
  };
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      add_triangle(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), reflectivity);
      add_triangle(mesh, at(i, j), at(i + 1, j + 1), at(i, j + 1), reflectivity);
    }
  }
}

}  // namespace lego_loam_sc
