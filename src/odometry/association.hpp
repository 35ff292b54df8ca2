// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "odometry/feature_index.hpp"
#include "odometry/settings.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// Point-to-line correspondences: the line through the nearest edge point of the previous scan and
/// the nearest edge point on a neighbouring row.
std::vector<Correspondence> associate_edges(const std::vector<FeaturePoint>& edges,
                                            const FeatureIndex& previous,
                                            const Pose& T_previous_current,
                                            const OdometrySettings& settings, double range_noise);

/// Point-to-plane correspondences: the plane through the planar points of the previous scan around
/// the nearest one, on its row and on neighbouring rows.
std::vector<Correspondence> associate_planars(const std::vector<FeaturePoint>& planars,
                                              const FeatureIndex& previous,
                                              const Pose& T_previous_current,
                                              const OdometrySettings& settings, double range_noise);

}  // namespace lego_loam_sc
