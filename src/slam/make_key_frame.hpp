// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pose.hpp"
#include "features/features.hpp"
#include "loop/key_frame.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"

namespace lego_loam_sc {

/// Thins a scan out to a key frame: `deskewed` are its features at the reference time, `twist` (m/s,
/// rad/s) de-skews the rest; `spacing` (m) is the voxel of the filter.
KeyFrame make_key_frame(const RangeImage& image, const Segmentation& segmentation,
                        const Features& deskewed, const Vector6& twist, double travelled,
                        double spacing);

/// All points of an image at its reference time, LiDAR frame.
std::vector<Eigen::Vector3f> deskewed_points(const RangeImage& image, const Vector6& twist);

}  // namespace lego_loam_sc
