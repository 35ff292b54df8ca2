// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {

struct G2oVertex {
  int id;
  Pose pose;  ///< T_world_vertex
};

struct G2oEdge {
  int from;
  int to;
  Pose T_from_to;
  Matrix6 information;  ///< of translation (m), then rotation vector (rad), in the frame `to`
};

/// Writes a pose graph as VERTEX_SE3:QUAT and EDGE_SE3:QUAT. The information matrix is written for
/// the rotation vector, upper triangle row by row, as GTSAM and common tools read g2o files; g2o
/// itself uses quaternion components. Throws InputError when writing fails.
void write_g2o(const std::filesystem::path& path, const std::vector<G2oVertex>& vertices,
               const std::vector<G2oEdge>& edges);

}  // namespace lego_loam_sc
