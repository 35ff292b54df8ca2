// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtsam/nonlinear/NonlinearFactorGraph.h>
#include <gtsam/nonlinear/Values.h>

#include <optional>
#include <vector>

#include "graph/chain_segment.hpp"
#include "graph/pose_graph.hpp"

namespace lego_loam_sc {

/// The odometry from key frame 0 to the last loop end, with one factor per segment between
/// neighbouring loop ends. Private to the pose graph.
class CondensedChain {
 public:
  /// `precision` (m and rad): a segment is relinearised when its links have moved by this in total,
  /// as iSAM2 relinearises its own variables.
  explicit CondensedChain(double precision) : precision_(precision) {}

  /// Divides the chain at `ends`, ascending from key frame 0. Existing segments between the same
  /// ends are kept.
  void divide(const std::vector<int>& ends, const std::vector<PoseEdge>& odometry);

  /// Linearises new segments, and those that have moved, at their present poses with a new factor.
  void condense_moved(const std::vector<PoseEdge>& odometry);

  /// Distributes the poses of the segment ends over the key frames between them.
  void expand(const gtsam::Values& ends);

  void add_factors(gtsam::NonlinearFactorGraph& graph) const;

  /// Pose of key frame i + 1 in the frame of key frame i.
  const std::vector<gtsam::Pose3>& relatives() const { return relatives_; }

 private:
  struct Section {
    ChainSegment segment;
    gtsam::NonlinearFactor::shared_ptr factor;  // null until the segment is condensed
    double moved = 0.0;                         // m and rad, sum over all links since then
    std::optional<gtsam::Pose3> expanded_to;    // relative pose of its ends at the last expansion
  };

  double precision_;
  std::vector<Section> sections_;
  std::vector<Link> links_;  // one per odometry edge, as last linearised
  std::vector<gtsam::Pose3> relatives_;
};

}  // namespace lego_loam_sc
