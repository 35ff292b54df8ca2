// SPDX-License-Identifier: BSD-3-Clause
#include "loop/radius_search.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace lego_loam_sc {

std::vector<LoopCandidate> search_radius(int query, const Eigen::Vector3d& position,
                                         std::span<const int> key_frames,
                                         std::span<const Eigen::Vector3d> positions,
                                         const RadiusSearchSettings& settings) {
  std::vector<LoopCandidate> candidates;
  for (std::size_t i = 0; i < key_frames.size(); ++i) {
    const double distance = (positions[i] - position).norm();
    if (distance <= settings.radius)
      candidates.push_back({query, key_frames[i], LoopCandidate::Detector::radius, distance, 0.0});
  }
  const auto kept = std::min<std::size_t>(candidates.size(), settings.candidates);
  const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(kept);
  std::partial_sort(candidates.begin(), end, candidates.end(), [](const auto& a, const auto& b) {
    return std::pair(a.distance, a.match) < std::pair(b.distance, b.match);
  });
  candidates.erase(end, candidates.end());
  return candidates;
}

}  // namespace lego_loam_sc
