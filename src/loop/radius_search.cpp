// SPDX-License-Identifier: BSD-3-Clause
#include "loop/radius_search.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace lego_loam_sc {

std::vector<LoopCandidate> search_radius(std::span<const Pose> T_map_key, int query,
                                         std::span<const int> eligible,
                                         const RadiusSearchSettings& settings) {
  std::vector<LoopCandidate> candidates;
  const Eigen::Vector3d position = T_map_key[query].translation();
  for (const int match : eligible) {
    const double distance = (T_map_key[match].translation() - position).norm();
    if (distance <= settings.radius)
      candidates.push_back({query, match, LoopCandidate::Detector::radius, distance, 0.0});
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
