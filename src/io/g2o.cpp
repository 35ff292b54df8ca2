// SPDX-License-Identifier: BSD-3-Clause
#include "io/g2o.hpp"

#include <string>

#include "core/text.hpp"
#include "io/atomic_file.hpp"

namespace lego_loam_sc {
namespace {

std::string pose_text(const Pose& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Eigen::Vector3d t = pose.translation();
  std::string text;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    text += " " + to_fixed(value, 9);
  return text;
}

}  // namespace

void write_g2o(const std::filesystem::path& path, const std::vector<G2oVertex>& vertices,
               const std::vector<G2oEdge>& edges) {
  AtomicFile file(path);
  for (const G2oVertex& vertex : vertices)
    file.write("VERTEX_SE3:QUAT " + std::to_string(vertex.id) + pose_text(vertex.pose) + "\n");
  for (const G2oEdge& edge : edges) {
    std::string line = "EDGE_SE3:QUAT " + std::to_string(edge.from) + " " +
                       std::to_string(edge.to) + pose_text(edge.T_from_to);
    for (int row = 0; row < 6; ++row)
      for (int column = row; column < 6; ++column)
        line += " " + to_text(edge.information(row, column));
    file.write(line + "\n");
  }
  file.commit();
}

}  // namespace lego_loam_sc
