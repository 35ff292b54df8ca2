// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "features/features.hpp"
#include "key_frames/key_frame.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"

namespace lego_loam_sc {

/// All points of an image at its reference time, LiDAR frame; `twist` in m/s and rad/s.
std::vector<Eigen::Vector3f> deskewed_points(const RangeImage& image, const Vector6& twist);

/// Thins a scan out to a key frame: `deskewed` are its features and `points` all its points, both
/// at the reference time; `spacing` (m) is the voxel of the filter.
KeyFrame make_key_frame(const RangeImage& image, const Segmentation& segmentation,
                        const Features& deskewed, std::span<const Eigen::Vector3f> points,
                        double travelled, double spacing);

}  // namespace lego_loam_sc
