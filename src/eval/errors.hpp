// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/pose.hpp"
#include "eval/association.hpp"

namespace lego_loam_sc {

struct Statistics {
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double min = 0.0;
  double max = 0.0;
};

/// Relative pose error (Sturm et al. 2012): the error of the motion between two poses.
struct RelativeError {
  Statistics translation;   ///< m
  Statistics rotation_deg;  ///< deg
};

/// KITTI odometry benchmark: mean error over all segments of 100, 200 .. 800 m of the true path,
/// one starting every 10 frames, divided by the length of the segment.
struct KittiError {
  double translation_percent = 0.0;    ///< t_rel
  double rotation_deg_per_100m = 0.0;  ///< r_rel
  std::size_t segments = 0;
};

/// Error of the last pose with the first poses aligned.
struct EndError {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< m, along the axes of the first pose
  double rotation_deg = 0.0;
};

struct TrajectoryError {
  std::size_t pairs = 0;
  double truth_length = 0.0;     ///< m, path length through the paired poses
  double estimate_length = 0.0;  ///< m
  Statistics ate;                ///< m, positions after rigid alignment (no scale)
  Statistics ate_unaligned;      ///< m, positions without alignment
  RelativeError rpe_frame;       ///< from each pose to the next
  /// Over consecutive segments of 1 m of the true path; nothing when the path is shorter.
  std::optional<RelativeError> rpe_metre;
  std::optional<KittiError> kitti;  ///< nothing when the true path is shorter than 100 m
  EndError end;
  double truth_first_to_last = 0.0;     ///< m between the first and the last pose
  double estimate_first_to_last = 0.0;  ///< m
};

/// The rigid transform that aligns the estimated to the true positions by least squares: Umeyama
/// 1991, eq. (40)-(43), scale 1. Returns `T_truth_estimate` between the map frames.
Pose align(std::span<const PosePair> pairs);

/// All errors of an estimate; at least two pairs in ascending order of time.
TrajectoryError evaluate(std::span<const PosePair> pairs);

}  // namespace lego_loam_sc
