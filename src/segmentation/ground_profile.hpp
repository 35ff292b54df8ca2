// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"

namespace lego_loam_sc {

/// The angle (rad) that, added to the elevation of every point, makes the ground ahead and behind
/// the sensor straight: an error common to all beams makes a cone of flat ground. A single scan
/// also sees the road's own curvature, which cancels only over a drive. The ground must be seen on
/// both sides and in six rows; nothing where it is not.
std::optional<double> cone_of_ground(const RangeImage& image, const Segmentation& segmentation);

}  // namespace lego_loam_sc
