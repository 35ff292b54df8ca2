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
    Stretch& stretch = divided[s].stretch;
    stretch.from = ends[s];
    stretch.to = ends[s + 1];
    while (old != sections_.end() && old->stretch.from < stretch.from) ++old;
    if (old != sections_.end() && old->stretch.from == stretch.from &&
        old->stretch.to == stretch.to)
      divided[s] = std::move(*old);
  }
  sections_ = std::move(divided);
}

void CondensedChain::condense_moved(const std::vector<PoseEdge>& odometry) {
  for (Section& section : sections_) {
    if (section.factor && section.moved < precision_) continue;
    Stretch& stretch = section.stretch;
    for (int i = stretch.from; i < stretch.to; ++i)
      links_[i] = linearised(odometry[i], relatives_[i]);
    stretch = condense(links_, stretch.from, stretch.to);
    section.moved = 0.0;
    section.expanded_to.reset();
    section.factor = boost::make_shared<RelativePoseFactor>(
        stretch.from, stretch.to, stretch.relative, stretch.offset,
        gtsam::noiseModel::Gaussian::Covariance(stretch.spread));
  }
}

void CondensedChain::expand(const gtsam::Values& ends) {
  for (Section& section : sections_) {
    const Stretch& stretch = section.stretch;
    const gtsam::Pose3 T_from_to =
        ends.at<gtsam::Pose3>(stretch.from).between(ends.at<gtsam::Pose3>(stretch.to));
    if (section.expanded_to && section.expanded_to->equals(T_from_to, 0.01 * precision_)) continue;
    section.expanded_to = T_from_to;
    section.moved = lego_loam_sc::expand(stretch, T_from_to, links_, relatives_);
  }
}

void CondensedChain::add_factors(gtsam::NonlinearFactorGraph& graph) const {
  for (const Section& section : sections_) graph.push_back(section.factor);
}

}  // namespace lego_loam_sc
