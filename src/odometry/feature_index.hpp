// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "features/features.hpp"

namespace lego_loam_sc {

/// Exact nearest-neighbour searches over the features of one scan: in space by a kd-tree, and
/// within one row by azimuth.
class FeatureIndex {
 public:
  /// `points` de-skewed, in ascending order of row.
  explicit FeatureIndex(std::vector<FeaturePoint> points);
  ~FeatureIndex();
  FeatureIndex(FeatureIndex&&) noexcept;
  FeatureIndex& operator=(FeatureIndex&&) noexcept;

  /// As given.
  const std::vector<FeaturePoint>& points() const;

  /// Index of the point nearest to `query` within `max_distance` (m), or -1.
  int nearest(const Eigen::Vector3f& query, float max_distance) const;

  /// The same among the points of row `row`.
  int nearest_in_row(const Eigen::Vector3f& query, int row, float max_distance) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lego_loam_sc
