// SPDX-License-Identifier: BSD-3-Clause
#include "loop/redundancy.hpp"

#include <algorithm>

namespace lego_loam_sc {
namespace {

// Mahalanobis distance from the optimised graph: below this a loop within kSameVisit of the last
// one is redundant.
constexpr double kConsistent = 0.5;
// The same near kWellTied loops. Of six degrees of freedom 2.5 is a usual value.
constexpr double kUsual = 2.5;
// m; loops that end within this distance are near.
constexpr double kNear = 50.0;

}  // namespace

double count_loops_near(int key_frame, const PoseGraph& graph) {
  const std::vector<Pose>& poses = graph.poses();
  const Eigen::Vector3d place = poses[key_frame].translation();
  return static_cast<double>(std::ranges::count_if(graph.loop_edges(), [&](const PoseEdge& loop) {
    return (poses[loop.to].translation() - place).norm() <= kNear;
  }));
}

bool is_redundant(const PoseEdge& loop, double since_last_loop, const PoseGraph& graph) {
  const double chi = graph.chi(loop);
  return (since_last_loop < kSameVisit && chi < kConsistent) ||
         (chi < kUsual && count_loops_near(loop.from, graph) >= kWellTied);
}

}  // namespace lego_loam_sc
