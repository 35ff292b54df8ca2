// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtsam/geometry/Pose3.h>

#include <vector>

#include "core/pose.hpp"
#include "graph/pose_graph.hpp"

namespace lego_loam_sc {

// Private to the pose graph, which speaks of GTSAM's poses here: tangent vectors are right
// perturbations with the rotation first.

gtsam::Pose3 to_gtsam(const Pose& pose);

/// The same covariance with the rotation first, or with the translation first again.
Matrix6 swap_blocks(const Matrix6& covariance);

/// An odometry edge during the optimisation, linearised at `relative`: a small motion x of its far
/// end costs || x + offset ||^2 with the covariance `spread`.
struct Link {
  gtsam::Pose3 relative;
  Vector6 offset = Vector6::Zero();
  Matrix6 spread = Matrix6::Zero();
};

/// Where the edge was measured, and anywhere else.
Link unmoved(const PoseEdge& edge);
Link linearised(const PoseEdge& edge, const gtsam::Pose3& relative);

/// The links from one loop end to the next as one: a small motion x of the far end costs
/// || x + offset ||^2 with the covariance `spread` when the key frames between are at their best.
struct Stretch {
  int from = 0;
  int to = 0;
  gtsam::Pose3 relative;
  Vector6 offset = Vector6::Zero();
  Matrix6 spread = Matrix6::Zero();
};

/// The links `from` to `to` - 1; link i leads from key frame i to the next.
Stretch condense(const std::vector<Link>& links, int from, int to);

/// Poses `relatives` of the links such that the stretch leads to T_from_to, the change shared by
/// least squares; exact when the change is small. Returns the sum of how far the links move from
/// where they are linearised, m and rad.
double expand(const Stretch& stretch, const gtsam::Pose3& T_from_to, const std::vector<Link>& links,
              std::vector<gtsam::Pose3>& relatives);

}  // namespace lego_loam_sc
