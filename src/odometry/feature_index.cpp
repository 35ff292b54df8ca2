// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/feature_index.hpp"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <numbers>
#include <utility>

#include "core/azimuth.hpp"

namespace lego_loam_sc {
namespace {

struct Adaptor {
  std::vector<FeaturePoint> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i].position[axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Adaptor>,
                                                 Adaptor, 3, std::uint32_t>;

// A point of a row for sorting by azimuth, which de-skewing changes slightly.
struct RowEntry {
  float azimuth;
  int index;

  bool operator<(const RowEntry& other) const {
    return std::pair(azimuth, index) < std::pair(other.azimuth, other.index);
  }
};

}  // namespace

struct FeatureIndex::Impl {
  explicit Impl(std::vector<FeaturePoint> points)
      : adaptor{std::move(points)}, tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {
    const int rows = adaptor.points.empty() ? 0 : adaptor.points.back().row + 1;
    row_begin.assign(rows + 1, 0);
    for (const FeaturePoint& p : adaptor.points) ++row_begin[p.row + 1];
    for (int r = 0; r < rows; ++r) row_begin[r + 1] += row_begin[r];
    entries.resize(adaptor.points.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Eigen::Vector3f& p = adaptor.points[i].position;
      entries[i] = {fast_atan2(p.y(), p.x()), static_cast<int>(i)};
    }
    for (int r = 0; r < rows; ++r)
      std::sort(entries.begin() + row_begin[r], entries.begin() + row_begin[r + 1]);
  }

  Adaptor adaptor;
  Tree tree;
  std::vector<int> row_begin;
  std::vector<RowEntry> entries;
};

FeatureIndex::FeatureIndex(std::vector<FeaturePoint> points)
    : impl_(std::make_unique<Impl>(std::move(points))) {}
FeatureIndex::~FeatureIndex() = default;
FeatureIndex::FeatureIndex(FeatureIndex&&) noexcept = default;
FeatureIndex& FeatureIndex::operator=(FeatureIndex&&) noexcept = default;

const std::vector<FeaturePoint>& FeatureIndex::points() const {
  return impl_->adaptor.points;
}

int FeatureIndex::nearest(const Eigen::Vector3f& query, float max_distance) const {
  if (points().empty()) return -1;
  std::uint32_t index = 0;
  float squared = 0.0f;
  nanoflann::KNNResultSet<float, std::uint32_t> result(1);
  result.init(&index, &squared);
  impl_->tree.findNeighbors(result, query.data());
  return squared <= max_distance * max_distance ? static_cast<int>(index) : -1;
}

int FeatureIndex::nearest_in_row(const Eigen::Vector3f& query, int row, float max_distance) const {
  if (row < 0 || row + 1 >= static_cast<int>(impl_->row_begin.size())) return -1;
  const RowEntry* begin = impl_->entries.data() + impl_->row_begin[row];
  const int count = impl_->row_begin[row + 1] - impl_->row_begin[row];
  if (count == 0) return -1;

  // Outwards from the query's azimuth in both directions, until the azimuth difference alone
  // implies a distance beyond the best.
  const float azimuth = fast_atan2(query.y(), query.x());
  const float horizontal = std::sqrt(query.x() * query.x() + query.y() * query.y());
  const int start =
      static_cast<int>(std::lower_bound(begin, begin + count, RowEntry{azimuth, -1}) - begin);
  int best = -1;
  float best_squared = max_distance * max_distance;
  const auto visit = [&](int position) {
    if (position < 0) position += count;
    if (position >= count) position -= count;
    const RowEntry& entry = begin[position];
    float turn = std::abs(entry.azimuth - azimuth);
    if (turn > std::numbers::pi_v<float>) turn = 2.0f * std::numbers::pi_v<float> - turn;
    if (turn < 0.5f * std::numbers::pi_v<float>) {
      // The slack covers the error of fast_atan2; t - t^3 / 6 is a little less than sin(t).
      const float t = std::max(turn - 5e-5f, 0.0f);
      const float bound = horizontal * t * (1.0f - t * t / 6.0f);
      if (bound * bound > best_squared) return false;
    } else if (horizontal * horizontal > best_squared) {
      return false;
    }
    const float squared = (points()[entry.index].position - query).squaredNorm();
    if (squared < best_squared || (squared == best_squared && entry.index < best)) {
      best = entry.index;
      best_squared = squared;
    }
    return true;
  };
  bool up = true;
  bool down = true;
  for (int k = 0; k < count && (up || down); ++k) {
    if (up) up = visit(start + k);
    if (down) down = visit(start - 1 - k);
  }
  return best;
}

}  // namespace lego_loam_sc
