// SPDX-License-Identifier: BSD-3-Clause
#include "graph/chain_segment.hpp"

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

Link linearised_at_measurement(const PoseEdge& edge) {
  return {to_gtsam(edge.T_from_to), Vector6::Zero(), swap_blocks(edge.covariance)};
}

Link linearised(const PoseEdge& edge, const Pose3& relative) {
  const Vector6 residual = Pose3::Logmap(to_gtsam(edge.T_from_to).inverse() * relative);
  const Matrix6 jacobian = Pose3::ExpmapDerivative(residual);
  return {relative, residual, jacobian * swap_blocks(edge.covariance) * jacobian.transpose()};
}

ChainSegment condense(const std::vector<Link>& links, int from, int to) {
  ChainSegment segment;
  segment.from = from;
  segment.to = to;
  for (int i = from; i < to; ++i) {
    const Link& link = links[i];
    const Matrix6 adjoint = link.relative.inverse().AdjointMap();
    segment.relative = segment.relative * link.relative;
    segment.offset = adjoint * segment.offset + link.offset;
    segment.covariance = adjoint * segment.covariance * adjoint.transpose() + link.covariance;
  }
  return segment;
}

double expand(const ChainSegment& segment, const Pose3& T_from_to, const std::vector<Link>& links,
              std::vector<Pose3>& relatives) {
  const Vector6 change = Pose3::Logmap(segment.relative.inverse() * T_from_to);
  Vector6 force = segment.covariance.ldlt().solve(change + segment.offset);
  double moved = 0.0;
  for (int i = segment.to - 1; i >= segment.from; --i) {
    const Link& link = links[i];
    const Vector6 motion = link.covariance * force - link.offset;
    relatives[i] = link.relative * Pose3::Expmap(motion);
    moved += motion.norm();
    force = link.relative.inverse().AdjointMap().transpose() * force;
  }
  return moved;
}

}  // namespace lego_loam_sc
