// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/thin_out.hpp"

#include "mapping/voxel_filter.hpp"

namespace lego_loam_sc {

Features thin_out(const Features& features, double spacing) {
  const auto thinned = [&](const std::vector<FeaturePoint>& points) {
    return voxel_filter(points, spacing, [](const FeaturePoint& p) { return p.position; });
  };
  Features thin;
  thin.planars_large = thinned(features.planars_large);
  thin.edges_large = thinned(features.edges_large);
  thin.scattered = thinned(features.scattered);
  return thin;
}

}  // namespace lego_loam_sc
