// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/range_image.hpp"

namespace lego_loam_sc {

/// Takes the points with a non-zero entry in `remove` (one per point) out of the image. Pixels fall
/// to the next nearest of their points, or to none.
void remove_points(const std::vector<std::uint8_t>& remove, RangeImage& image);

}  // namespace lego_loam_sc
