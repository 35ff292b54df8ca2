// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/thin_out.hpp"

#include "mapping/voxel_filter.hpp"

namespace lego_loam_sc {

Features thin_out(const Features& features, double spacing) {
  const auto position = [](const FeaturePoint& p) { return p.position; };
  Features thin;
  for (const auto set : kMapSets) thin.*set = voxel_filter(features.*set, spacing, position);
  return thin;
}

}  // namespace lego_loam_sc
