// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/pose.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// How well each direction of a pose is held by the correspondences of a match. Rotation and
/// translation are judged apart, because their units differ. The strength of a direction is the
/// number of whole constraints along it, each counted by the square of the cosine between its
/// normal and the direction; those nearly across the direction do not count, because what they
/// say along it is the noise of their normals (X-ICP, T-RO 2023, section IV).
struct Localizability {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< strength along each axis
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d translation_axes = Eigen::Matrix3d::Identity();  ///< columns, target frame;
  Eigen::Matrix3d rotation_axes = Eigen::Matrix3d::Identity();     ///< the weakest comes first
  int degenerate_translations = 0;  ///< the first so many axes are degenerate
  int degenerate_rotations = 0;

  bool degenerate() const { return degenerate_translations + degenerate_rotations > 0; }
};

/// A direction with a strength below `min_strength` is degenerate. `scale` (sigmas) is that of the
/// robust kernel; rotation is about the origin of the source frame.
Localizability localizability(std::span<const Correspondence> correspondences,
                              const Pose& T_target_source, double scale, double min_strength);

}  // namespace lego_loam_sc
