// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "core/pose.hpp"
#include "graph/pose_graph.hpp"

namespace lego_loam_sc {

// The plain least-squares optimum by Gauss-Newton over all poses at once, with dense matrices and
// numeric derivatives: slow, and with nothing in common with the graph.
inline std::vector<Pose> dense_optimum(std::vector<Pose> poses,
                                       const std::vector<PoseEdge>& edges) {
  const int unknowns = 6 * (static_cast<int>(poses.size()) - 1);
  const auto residual = [](const PoseEdge& edge, const Pose& from, const Pose& to) -> Vector6 {
    return log_se3(edge.T_from_to.inverse() * from.inverse() * to);
  };
  const auto nudged = [](const Pose& pose, int axis, double step) {
    return Pose(pose * exp_se3(step * Vector6::Unit(axis)));
  };
  constexpr double kStep = 1e-6;
  for (int iteration = 0; iteration < 15; ++iteration) {
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(unknowns + 6, unknowns + 6);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(unknowns + 6);
    for (const PoseEdge& edge : edges) {
      const Pose& from = poses[edge.from];
      const Pose& to = poses[edge.to];
      Eigen::Matrix<double, 6, 12> jacobian;
      for (int axis = 0; axis < 6; ++axis) {
        jacobian.col(axis) = (residual(edge, nudged(from, axis, kStep), to) -
                              residual(edge, nudged(from, axis, -kStep), to)) /
                             (2.0 * kStep);
        jacobian.col(6 + axis) = (residual(edge, from, nudged(to, axis, kStep)) -
                                  residual(edge, from, nudged(to, axis, -kStep))) /
                                 (2.0 * kStep);
      }
      const Matrix6 information = edge.covariance.inverse();
      const Eigen::Matrix<double, 12, 12> h = jacobian.transpose() * information * jacobian;
      const Eigen::Matrix<double, 12, 1> g =
          jacobian.transpose() * information * residual(edge, from, to);
      const int at[] = {6 * edge.from, 6 * edge.to};
      for (int r = 0; r < 2; ++r) {
        gradient.segment<6>(at[r]) += g.segment<6>(6 * r);
        for (int c = 0; c < 2; ++c)
          hessian.block<6, 6>(at[r], at[c]) += h.block<6, 6>(6 * r, 6 * c);
      }
    }
    const Eigen::VectorXd step =
        hessian.bottomRightCorner(unknowns, unknowns).ldlt().solve(-gradient.tail(unknowns));
    for (std::size_t i = 1; i < poses.size(); ++i)
      poses[i] = normalized(poses[i] * exp_se3(step.segment<6>(6 * static_cast<int>(i) - 6)));
  }
  return poses;
}

}  // namespace lego_loam_sc
