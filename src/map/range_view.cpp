// SPDX-License-Identifier: BSD-3-Clause
#include "map/range_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/azimuth.hpp"

namespace lego_loam_sc {
namespace {

constexpr int kColumns = 360;
constexpr float kMinBin = 0.0175f;  // rad, one degree
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A surface is seen within this of its range: m, and a share for the slant of a surface within a
// direction.
constexpr float kMargin = 0.3f;
constexpr float kMarginShare = 0.02f;
// Of the nine directions round a place so many must have been seen to call it free.
constexpr int kMinSeen = 5;

float elevation(const Eigen::Vector3f& p) {
  return fast_atan2(p.z(), std::sqrt(p.x() * p.x() + p.y() * p.y()));
}

int column_of(const Eigen::Vector3f& p) {
  const float turns = fast_atan2(p.y(), p.x()) / (2.0f * std::numbers::pi_v<float>)+0.5f;
  return std::clamp(static_cast<int>(turns * kColumns), 0, kColumns - 1);
}

}  // namespace

RangeView::RangeView(std::span<const Eigen::Vector3f> points, double row_spacing)
    : bin_(std::max(kMinBin, static_cast<float>(row_spacing))) {
  std::vector<float> elevations;
  elevations.reserve(points.size());
  for (const Eigen::Vector3f& p : points) elevations.push_back(elevation(p));
  if (elevations.empty()) return;
  const auto [lowest, highest] = std::ranges::minmax(elevations);
  lowest_ = lowest;
  rows_ = 1 + static_cast<int>((highest - lowest) / bin_);
  nearest_.assign(static_cast<std::size_t>(rows_) * kColumns, kInfinity);
  farthest_.assign(nearest_.size(), 0.0f);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<std::size_t>((elevations[i] - lowest_) / bin_);
    const std::size_t k = row * kColumns + static_cast<std::size_t>(column_of(points[i]));
    const float range = points[i].norm();
    nearest_[k] = std::min(nearest_[k], range);
    farthest_[k] = std::max(farthest_[k], range);
  }
}

int RangeView::row_of(const Eigen::Vector3f& point) const {
  return static_cast<int>(std::floor((elevation(point) - lowest_) / bin_));
}

RangeView::Sight RangeView::sight(const Eigen::Vector3f& point) const {
  const int row = row_of(point);
  if (rows_ == 0 || row < 0 || row >= rows_) return Sight::unknown;
  const int column = column_of(point);
  float nearest = kInfinity;
  float farthest = 0.0f;
  int seen = 0;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
    for (int c = column - 1; c <= column + 1; ++c) {
      const std::size_t k = static_cast<std::size_t>(r) * kColumns +
                            static_cast<std::size_t>((c + kColumns) % kColumns);
      if (nearest_[k] == kInfinity) continue;
      ++seen;
      nearest = std::min(nearest, nearest_[k]);
      farthest = std::max(farthest, farthest_[k]);
    }
  }
  const float range = point.norm();
  const float margin = kMargin + kMarginShare * range;
  if (seen == 0 || range > farthest + margin) return Sight::unknown;
  if (range >= nearest - margin) return Sight::surface;
  return seen >= kMinSeen ? Sight::free : Sight::unknown;
}

}  // namespace lego_loam_sc
