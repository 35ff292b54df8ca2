// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/pose.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// How well the correspondences of a match constrain each direction of the pose. Rotation and
/// translation are analysed separately, because their units differ. The strength of a direction is
/// the number of constraints along it, each weighted by the squared cosine between its normal and
/// the direction. Constraints almost perpendicular to the direction do not count: what they say
/// about it is the noise of their normals (X-ICP, T-RO 2023, section IV).
struct Localizability {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< strength along each axis
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d translation_axes = Eigen::Matrix3d::Identity();  ///< columns, target frame,
  Eigen::Matrix3d rotation_axes = Eigen::Matrix3d::Identity();     ///< weakest first
  /// Of each axis, the share of what the correspondences say along it that is to be believed: 0 of
  /// a degenerate one, 1 where there is no doubt.
  /// @{
  Eigen::Vector3d translation_certainty = Eigen::Vector3d::Ones();
  Eigen::Vector3d rotation_certainty = Eigen::Vector3d::Ones();
  /// @}
  int degenerate_translations = 0;  ///< number of axes with a certainty of 0
  int degenerate_rotations = 0;

  /// Whether anything along an axis is not to be believed.
  bool uncertain() const {
    return translation_certainty.minCoeff() < 1.0 || rotation_certainty.minCoeff() < 1.0;
  }
  /// Whether any axis is.
  bool degenerate() const { return degenerate_translations + degenerate_rotations > 0; }
};

/// A direction with a strength below `min_strength` is degenerate. `scale` (sigmas) is that of the
/// robust kernel; rotation is about the origin of the source frame.
Localizability localizability(std::span<const Correspondence> correspondences,
                              const Pose& T_target_source, double scale, double min_strength);

/// The component of a perturbation (translation first) along the degenerate directions, and that
/// along uncertain ones by the uncertain share.
Vector6 degenerate_component(const Localizability& localizability, const Vector6& delta);

/// The same as a matrix, with its translation and rotation blocks
/// multiplied by these weights.
Matrix6 degenerate_projection(const Localizability& localizability, double translation_weight,
                              double rotation_weight);

}  // namespace lego_loam_sc
