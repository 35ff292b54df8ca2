// SPDX-License-Identifier: BSD-3-Clause
#include "graph/map_fragments.hpp"

#include <algorithm>
#include <set>

namespace lego_loam_sc {

void MapFragments::begin(int key_frame) {
  map_.push_back(static_cast<int>(first_.size()));
  first_.push_back(key_frame);
}

int MapFragments::fragment_of(int key_frame) const {
  return static_cast<int>(std::upper_bound(first_.begin(), first_.end(), key_frame) -
                          first_.begin()) -
         1;
}

void MapFragments::join(int a, int b) {
  const auto [kept, gone] = std::minmax({map_[fragment_of(a)], map_[fragment_of(b)]});
  std::replace(map_.begin(), map_.end(), gone, kept);
}

int MapFragments::maps() const {
  return static_cast<int>(std::set(map_.begin(), map_.end()).size());
}

Matrix6 unconstrained_covariance() {
  constexpr double kSigma = 100.0;        // m
  constexpr double kSigmaRotation = 1.0;  // rad
  Matrix6 covariance = Matrix6::Zero();
  covariance.diagonal() << Eigen::Vector3d::Constant(kSigma * kSigma),
      Eigen::Vector3d::Constant(kSigmaRotation * kSigmaRotation);
  return covariance;
}

}  // namespace lego_loam_sc
