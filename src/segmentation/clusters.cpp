// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/pose.hpp"

namespace lego_loam_sc {
namespace {

// Columns that a horizontal pair may be apart: one empty pixel in between breaks no surface.
constexpr int kMaxColumnStep = 2;

class UnionFind {
 public:
  explicit UnionFind(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::int32_t root(std::int32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  // The smaller index becomes the root, so that roots do not depend on the order of the calls.
  void join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<std::int32_t> parent_;
};

// beta > limit for two ranges whose beams are alpha apart:
// beta = atan2(d2 sin alpha, d1 - d2 cos alpha) with d1 >= d2. `slack` forgives range noise, which
// otherwise breaks up surfaces whose neighbours are close together.
class SameObject {
 public:
  SameObject(double alpha, double limit_tangent, double slack)
      : sine_(static_cast<float>(std::sin(alpha))),
        cosine_(static_cast<float>(std::cos(alpha))),
        tangent_(static_cast<float>(limit_tangent)),
        slack_(static_cast<float>(slack)) {}

  bool operator()(float a, float b) const {
    const float d1 = std::max(a, b);
    const float d2 = std::min(a, b);
    return d2 * sine_ > tangent_ * (d1 - d2 * cosine_ - slack_);
  }

 private:
  float sine_, cosine_, tangent_, slack_;
};

void join_rows(const RangeImage& image, const std::vector<Label>& label, double limit_tangent,
               double slack, UnionFind& sets) {
  const double step = 2.0 * std::numbers::pi / image.columns;
  std::vector<SameObject> same;
  for (int gap = 0; gap <= kMaxColumnStep; ++gap)
    same.emplace_back(std::max(gap, 1) * step, limit_tangent, slack);

  const auto try_join = [&](std::uint32_t a, std::uint32_t b, int gap) {
    if (gap > kMaxColumnStep || label[a] == Label::ground || label[b] == Label::ground) return;
    if (same[gap](image.range[a], image.range[b]))
      sets.join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
  };
  for (int row = 0; row < image.rows; ++row) {
    const std::uint32_t begin = image.row_begin[row];
    const std::uint32_t end = image.row_begin[row + 1];
    if (end - begin < 2) continue;
    for (std::uint32_t i = begin + 1; i < end; ++i)
      try_join(i - 1, i, image.column[i] - image.column[i - 1]);
    try_join(end - 1, begin, image.column[begin] + image.columns - image.column[end - 1]);
  }
}

void join_columns(const RangeImage& image, const SensorModel& sensor,
                  const std::vector<Label>& label, double limit_tangent, double slack,
                  UnionFind& sets) {
  for (int row = 0; row + 1 < image.rows; ++row) {
    const double alpha = radians(sensor.elevation_deg[row + 1] - sensor.elevation_deg[row]);
    const SameObject same(alpha, limit_tangent, slack);
    for (int column = 0; column < image.columns; ++column) {
      const std::int32_t a = image.pixel(row, column);
      if (a < 0 || label[a] == Label::ground) continue;
      std::int32_t b = image.pixel(row + 1, column);
      if (b < 0) b = image.pixel(row + 1, (column + 1) % image.columns);
      if (b < 0 || label[b] == Label::ground) continue;
      if (same(image.range[a], image.range[b])) sets.join(a, b);
    }
  }
}

struct Extent {
  int points = 0;
  int rows = 0;
  int last_row = -1;
};

}  // namespace

int cluster(const RangeImage& image, const SensorModel& sensor,
            const SegmentationSettings& settings, std::vector<Label>& label,
            std::vector<std::int32_t>& cluster) {
  const double limit_tangent = std::tan(radians(settings.cluster_angle_deg));
  const double slack = 3.0 * sensor.range_noise;
  UnionFind sets(image.size());
  join_rows(image, label, limit_tangent, slack, sets);
  join_columns(image, sensor, label, limit_tangent, slack, sets);

  std::vector<Extent> extent(image.size());
  for (int row = 0; row < image.rows; ++row) {
    for (std::uint32_t i = image.row_begin[row]; i < image.row_begin[row + 1]; ++i) {
      if (label[i] == Label::ground) continue;
      Extent& e = extent[sets.root(static_cast<std::int32_t>(i))];
      ++e.points;
      if (e.last_row != row) ++e.rows;
      e.last_row = row;
    }
  }

  int clusters = 0;
  cluster.assign(image.size(), -1);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (label[i] == Label::ground) continue;
    const std::int32_t root = sets.root(static_cast<std::int32_t>(i));
    const Extent& e = extent[root];
    const bool large = e.points >= settings.cluster_min_points;
    const bool thin = e.points >= settings.thin_cluster_min_points &&
                      e.rows >= settings.thin_cluster_min_rows;
    if (!large && !thin) continue;
    label[i] = Label::segment;
    // A root is the smallest index of its cluster, hence numbered before its members.
    cluster[i] = cluster[root] >= 0 ? cluster[root] : clusters++;
  }
  return clusters;
}

}  // namespace lego_loam_sc
