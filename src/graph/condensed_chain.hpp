// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtsam/nonlinear/NonlinearFactorGraph.h>
#include <gtsam/nonlinear/Values.h>

#include <optional>
#include <vector>

#include "graph/pose_graph.hpp"
#include "graph/stretch.hpp"

namespace lego_loam_sc {

/// The odometry from key frame 0 to the last loop end, with one factor for each stretch between
/// two neighbouring ends. Private to the pose graph.
class CondensedChain {
 public:
  /// m and rad that the links of a stretch may move in all before it is linearised anew: the
  /// threshold of iSAM2's fluid relinearisation, carried over to what iSAM2 does not see.
  explicit CondensedChain(double precision) : precision_(precision) {}

  /// `ends` ascend from key frame 0. Stretches between the same ends as before stay as they are.
  void divide(const std::vector<int>& ends, const std::vector<PoseEdge>& odometry);

  /// Linearises new stretches, and those that have moved, where they are now; each of them gets
  /// a new factor.
  void condense_moved(const std::vector<PoseEdge>& odometry);

  /// Fits the key frames of every stretch between the poses of its ends.
  void expand(const gtsam::Values& ends);

  void add_factors(gtsam::NonlinearFactorGraph& graph) const;

  /// Pose of key frame i + 1 in the frame of key frame i.
  const std::vector<gtsam::Pose3>& relatives() const { return relatives_; }

 private:
  struct Section {
    Stretch stretch;
    gtsam::NonlinearFactor::shared_ptr factor;  // none before the stretch is condensed
    double moved = 0.0;                         // m and rad, of all links since then
    std::optional<gtsam::Pose3> expanded_to;    // pose of its end in its beginning, since then
  };

  double precision_;
  std::vector<Section> sections_;
  std::vector<Link> links_;  // one per odometry edge, where its stretch was condensed
  std::vector<gtsam::Pose3> relatives_;
};

}  // namespace lego_loam_sc
