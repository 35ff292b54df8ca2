// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/pose.hpp"
#include "features/features.hpp"

namespace lego_loam_sc {

/// The sensor's motion during one sweep at constant body velocity: maps a point measured `time`
/// seconds after the reference time into the sensor's frame at the reference time.
class SweepMotion {
 public:
  /// `twist` in m/s and rad/s, `span` the largest absolute time in s.
  SweepMotion(const Vector6& twist, float span);

  Eigen::Vector3f operator()(const Eigen::Vector3f& point, float time) const {
    const float position = (time + span_) * steps_per_second_;
    const int step = std::clamp(static_cast<int>(position), 0, kSteps - 1);
    const float share = position - static_cast<float>(step);
    const Transform transform = (1.0f - share) * transforms_[step] + share * transforms_[step + 1];
    return transform.leftCols<3>() * point + transform.col(3);
  }

 private:
  // Transforms at equal steps of time, interpolated linearly: over 0.1 s at 10 rad/s the error is
  // 3e-5 of the range.
  static constexpr int kSteps = 64;
  using Transform = Eigen::Matrix<float, 3, 4>;
  std::array<Transform, kSteps + 1> transforms_;
  float span_ = 0.0f;
  float steps_per_second_ = 0.0f;
};

/// The largest absolute time of the points, s.
float max_abs_time(const std::vector<FeaturePoint>& points);

/// The points moved to the reference time of their scan; their `time` is kept.
std::vector<FeaturePoint> deskew(const std::vector<FeaturePoint>& points, const Vector6& twist);

/// The same for all sets.
Features deskew(const Features& features, const Vector6& twist);

}  // namespace lego_loam_sc
