// SPDX-License-Identifier: BSD-3-Clause
#include "graph/stretch.hpp"

namespace lego_loam_sc {

using gtsam::Pose3;

Pose3 to_gtsam(const Pose& pose) {
  return {pose.matrix()};
}

Matrix6 swap_blocks(const Matrix6& covariance) {
  Matrix6 result;
  result << covariance.bottomRightCorner<3, 3>(), covariance.bottomLeftCorner<3, 3>(),
      covariance.topRightCorner<3, 3>(), covariance.topLeftCorner<3, 3>();
  return result;
}

Link unmoved(const PoseEdge& edge) {
  return {to_gtsam(edge.T_from_to), Vector6::Zero(), swap_blocks(edge.covariance)};
}

Link linearised(const PoseEdge& edge, const Pose3& relative) {
  const Vector6 residual = Pose3::Logmap(to_gtsam(edge.T_from_to).inverse() * relative);
  const Matrix6 jacobian = Pose3::ExpmapDerivative(residual);
  return {relative, residual, jacobian * swap_blocks(edge.covariance) * jacobian.transpose()};
}

Stretch condense(const std::vector<Link>& links, int from, int to) {
  Stretch stretch;
  stretch.from = from;
  stretch.to = to;
  for (int i = from; i < to; ++i) {
    const Link& link = links[i];
    const Matrix6 adjoint = link.relative.inverse().AdjointMap();
    stretch.relative = stretch.relative * link.relative;
    stretch.offset = adjoint * stretch.offset + link.offset;
    stretch.spread = adjoint * stretch.spread * adjoint.transpose() + link.spread;
  }
  return stretch;
}

double expand(const Stretch& stretch, const Pose3& T_from_to, const std::vector<Link>& links,
              std::vector<Pose3>& relatives) {
  const Vector6 change = Pose3::Logmap(stretch.relative.inverse() * T_from_to);
  Vector6 pull = stretch.spread.ldlt().solve(change + stretch.offset);
  double moved = 0.0;
  for (int i = stretch.to - 1; i >= stretch.from; --i) {
    const Link& link = links[i];
    const Vector6 motion = link.spread * pull - link.offset;
    relatives[i] = link.relative * Pose3::Expmap(motion);
    moved += motion.norm();
    pull = link.relative.inverse().AdjointMap().transpose() * pull;
  }
  return moved;
}

}  // namespace lego_loam_sc
