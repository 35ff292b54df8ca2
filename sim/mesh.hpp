// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"
#include "sim/geometry.hpp"

namespace lego_loam_sc {

/// Triangles in world coordinates, m. Both sides of a triangle reflect.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of vertices
  std::vector<float> reflectivity;                      ///< one for each triangle, 0 to 1
};

/// A quadrilateral with its corners in order round the edge.
void add_quad(Mesh& mesh, const std::array<Eigen::Vector3d, 4>& corners, double reflectivity);

/// A box of `size`; `T_world_box` places the centre of its bottom face.
void add_box(Mesh& mesh, const Pose& T_world_box, const Eigen::Vector3d& size, double reflectivity);

/// A horizontal rectangle of a frustum: x from `rear` to `front`, y from -half_width to half_width.
struct Slice {
  double rear, front, half_width, z;
};

/// The solid between two slices, given in its own frame, with its own material on top.
void add_frustum(Mesh& mesh, const Pose& T_world_solid, const Slice& bottom, const Slice& top,
                 double side_reflectivity, double top_reflectivity);

/// A closed cylinder along z; `T_world_cylinder` places the centre of its bottom.
void add_cylinder(Mesh& mesh, const Pose& T_world_cylinder, double radius, double height,
                  double reflectivity);

/// A cylinder from one point to another, as for pipes and struts.
void add_rod(Mesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
             double reflectivity);

/// Adds all of `part`, shifted.
void add_mesh(Mesh& mesh, const Mesh& part, const Eigen::Vector3d& shift);

/// The ground over the rectangle from `low` to `high`, raised by `offset`, in square cells of
/// `spacing` (rounded so that they fit).
void add_height_field(Mesh& mesh, const Ground& ground, const Eigen::Vector2d& low,
                      const Eigen::Vector2d& high, double spacing, double offset,
                      double reflectivity);

}  // namespace lego_loam_sc
