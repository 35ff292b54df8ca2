// SPDX-License-Identifier: BSD-3-Clause
#include "map/thin_out.hpp"

#include "map/voxel_filter.hpp"

namespace lego_loam_sc {

Features thin_out(const Features& features, double spacing) {
  const auto position = [](const FeaturePoint& p) { return p.position; };
  Features thin;
  for (const auto set : kMapSets) thin.*set = voxel_filter(features.*set, spacing, position);
  return thin;
}

}  // namespace lego_loam_sc
