// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtsam/geometry/Pose3.h>

#include <vector>

#include "core/pose.hpp"
#include "graph/pose_graph.hpp"

namespace lego_loam_sc {

// Private to the pose graph. In GTSAM's convention: tangent vectors are right perturbations with
// the rotation first.

gtsam::Pose3 to_gtsam(const Pose& pose);

/// Swaps the translation and rotation blocks of a covariance.
Matrix6 swap_blocks(const Matrix6& covariance);

/// An odometry edge during the optimisation, linearised at `relative`: a small motion x of its far
/// end costs || x + offset ||^2 with the covariance `covariance`.
struct Link {
  gtsam::Pose3 relative;
  Vector6 offset = Vector6::Zero();
  Matrix6 covariance = Matrix6::Zero();
};

/// The link of an odometry edge, linearised at its measurement or at another relative pose.
Link linearised_at_measurement(const PoseEdge& edge);
Link linearised(const PoseEdge& edge, const gtsam::Pose3& relative);

/// The links from one loop end to the next, with the key frames between them marginalised: a small
/// motion x of the far end costs || x + offset ||^2 with the covariance `covariance`.
struct ChainSegment {
  int from = 0;
  int to = 0;
  gtsam::Pose3 relative;
  Vector6 offset = Vector6::Zero();
  Matrix6 covariance = Matrix6::Zero();
};

/// Condenses the links `from` to `to` - 1; link i leads from key frame i to i + 1.
ChainSegment condense(const std::vector<Link>& links, int from, int to);

/// Sets `relatives` of the links so that the segment leads to T_from_to; the change is distributed
/// by least squares, exact for small changes. Returns the sum of the distances of the links from
/// their linearisation points, m and rad.
double expand(const ChainSegment& segment, const gtsam::Pose3& T_from_to,
              const std::vector<Link>& links, std::vector<gtsam::Pose3>& relatives);

}  // namespace lego_loam_sc
