// SPDX-License-Identifier: BSD-3-Clause
#include "graph/condensed_chain.hpp"

#include <utility>

#include "graph/relative_pose_factor.hpp"

namespace lego_loam_sc {

void CondensedChain::divide(const std::vector<int>& ends, const std::vector<PoseEdge>& odometry) {
  relatives_.resize(ends.back());
  for (std::size_t i = links_.size(); i < relatives_.size(); ++i)
    relatives_[i] = to_gtsam(odometry[i].T_from_to);
  links_.resize(ends.back());

  std::vector<Section> divided(ends.size() - 1);
  auto old = sections_.begin();
  for (std::size_t s = 0; s < divided.size(); ++s) {
    ChainSegment& segment = divided[s].segment;
    segment.from = ends[s];
    segment.to = ends[s + 1];
    while (old != sections_.end() && old->segment.from < segment.from) ++old;
    if (old != sections_.end() && old->segment.from == segment.from &&
        old->segment.to == segment.to)
      divided[s] = std::move(*old);
  }
  sections_ = std::move(divided);
}

void CondensedChain::condense_moved(const std::vector<PoseEdge>& odometry) {
  for (Section& section : sections_) {
    if (section.factor && section.moved < precision_) continue;
    ChainSegment& segment = section.segment;
    for (int i = segment.from; i < segment.to; ++i)
      links_[i] = linearised(odometry[i], relatives_[i]);
    segment = condense(links_, segment.from, segment.to);
    section.moved = 0.0;
    section.expanded_to.reset();
    section.factor = boost::make_shared<RelativePoseFactor>(
        segment.from, segment.to, segment.relative, segment.offset,
        gtsam::noiseModel::Gaussian::Covariance(segment.covariance));
  }
}

void CondensedChain::expand(const gtsam::Values& ends) {
  for (Section& section : sections_) {
    const ChainSegment& segment = section.segment;
    const gtsam::Pose3 T_from_to =
        ends.at<gtsam::Pose3>(segment.from).between(ends.at<gtsam::Pose3>(segment.to));
    if (section.expanded_to && section.expanded_to->equals(T_from_to, 0.01 * precision_)) continue;
    section.expanded_to = T_from_to;
    section.moved = lego_loam_sc::expand(segment, T_from_to, links_, relatives_);
  }
}

void CondensedChain::add_factors(gtsam::NonlinearFactorGraph& graph) const {
  for (const Section& section : sections_) graph.push_back(section.factor);
}

}  // namespace lego_loam_sc
