// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracked_scan.hpp"

namespace lego_loam_sc {

ScanCounts counts_of(const FrontEnd& front_end) {
  const auto& [image, segmentation, features, mounting, milliseconds] = front_end;
  return {image.size(),
          segmentation.ground_points,
          segmentation.segment_points,
          segmentation.clusters,
          features.edges_sharp.size(),
          features.planars_flat.size(),
          features.edges_large.size(),
          features.planars_large.size()};
}

}  // namespace lego_loam_sc
