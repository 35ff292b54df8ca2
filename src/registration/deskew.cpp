// SPDX-License-Identifier: BSD-3-Clause
#include "registration/deskew.hpp"

#include <algorithm>
#include <cmath>

namespace lego_loam_sc {

SweepMotion::SweepMotion(const Vector6& twist, float span) : span_(span) {
  for (int k = 0; k <= kSteps; ++k) {
    const double time = static_cast<double>(span) * (2.0 * k / kSteps - 1.0);
    transforms_[k] = exp_se3(twist * time).matrix().topRows<3>().cast<float>();
  }
  if (span > 0.0f) steps_per_second_ = kSteps / (2.0f * span);
}

float max_abs_time(const std::vector<FeaturePoint>& points) {
  float span = 0.0f;
  for (const FeaturePoint& p : points) span = std::max(span, std::abs(p.time));
  return span;
}

std::vector<FeaturePoint> deskew(const std::vector<FeaturePoint>& points, const Vector6& twist) {
  std::vector<FeaturePoint> moved = points;
  const float span = max_abs_time(points);
  if (span == 0.0f) return moved;
  const SweepMotion motion(twist, span);
  for (FeaturePoint& p : moved) p.position = motion(p.position, p.time);
  return moved;
}

Features deskew(const Features& features, const Vector6& twist) {
  return {deskew(features.edges_sharp, twist), deskew(features.planars_flat, twist),
          deskew(features.edges_large, twist), deskew(features.planars_large, twist),
          deskew(features.scattered, twist)};
}

}  // namespace lego_loam_sc
