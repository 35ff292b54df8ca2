// SPDX-License-Identifier: BSD-3-Clause
#include "map/voxel_filter.hpp"

namespace lego_loam_sc {

Features voxel_filter(const Features& features, double size) {
  const auto position = [](const FeaturePoint& p) { return p.position; };
  Features filtered;
  for (const auto set : kMapSets) filtered.*set = voxel_filter(features.*set, size, position);
  return filtered;
}

}  // namespace lego_loam_sc
