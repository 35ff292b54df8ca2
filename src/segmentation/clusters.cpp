// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/pose.hpp"

namespace lego_loam_sc {
namespace {

// Largest column difference of neighbours in a row: one empty pixel does not split a surface.
constexpr int kMaxColumnStep = 2;

// Runs of connected neighbours along a row. Columns join runs instead of points, because there are
// ten times fewer of them.
struct Runs {
  std::vector<std::int32_t> of_point;  // run of each point, -1 on the ground
  std::vector<std::int32_t> row;
  std::vector<std::int32_t> points;

  std::int32_t count() const { return static_cast<std::int32_t>(row.size()); }
};

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
// beta = atan2(d2 sin alpha, d1 - d2 cos alpha) with d1 >= d2. `slack` (m) tolerates range noise,
// which would split surfaces whose neighbours are close together.
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

// Whether two neighbours in a row, `gap` columns apart, belong to one object.
class SameInRow {
 public:
  SameInRow(int columns, double limit_tangent, double slack) {
    for (int gap = 0; gap <= kMaxColumnStep; ++gap)
      of_gap_.emplace_back(std::max(gap, 1) * 2.0 * std::numbers::pi / columns, limit_tangent,
                           slack);
  }

  bool operator()(const RangeImage& image, std::uint32_t a, std::uint32_t b, int gap) const {
    return gap <= kMaxColumnStep && of_gap_[gap](image.range[a], image.range[b]);
  }

 private:
  std::vector<SameObject> of_gap_;
};

Runs make_runs(const RangeImage& image, const std::vector<Label>& label, const SameInRow& same) {
  Runs runs;
  runs.of_point.resize(image.size());
  for (int row = 0; row < image.rows; ++row) {
    std::int32_t run = -1;  // of the previous point
    for (std::uint32_t i = image.row_begin[row]; i < image.row_begin[row + 1]; ++i) {
      if (label[i] == Label::ground) {
        run = -1;
      } else if (run < 0 || !same(image, i - 1, i, image.column[i] - image.column[i - 1])) {
        run = runs.count();
        runs.row.push_back(row);
        runs.points.push_back(0);
      }
      runs.of_point[i] = run;
      if (run >= 0) ++runs.points[run];
    }
  }
  return runs;
}

// The last column of a row is the neighbour of the first.
void join_seams(const RangeImage& image, const SameInRow& same, const Runs& runs, UnionFind& sets) {
  for (int row = 0; row < image.rows; ++row) {
    const std::uint32_t first = image.row_begin[row];
    const std::uint32_t end = image.row_begin[row + 1];
    if (end - first < 2) continue;
    const std::int32_t a = runs.of_point[end - 1];
    const std::int32_t b = runs.of_point[first];
    const int gap = image.column[first] + image.columns - image.column[end - 1];
    if (a >= 0 && b >= 0 && same(image, end - 1, first, gap)) sets.join(a, b);
  }
}

void join_columns(const RangeImage& image, const SensorModel& sensor, const Runs& runs,
                  double limit_tangent, double slack, UnionFind& sets) {
  for (int row = 0; row + 1 < image.rows; ++row) {
    const double alpha = radians(sensor.elevation_deg[row + 1] - sensor.elevation_deg[row]);
    const SameObject same(alpha, limit_tangent, slack);
    // Most pairs join the same two runs as the previous pair.
    std::int32_t joined_lower = -1;
    std::int32_t joined_upper = -1;
    for (int column = 0; column < image.columns; ++column) {
      const std::int32_t a = image.pixel(row, column);
      if (a < 0) continue;
      std::int32_t b = image.pixel(row + 1, column);
      if (b < 0) b = image.pixel(row + 1, column + 1 < image.columns ? column + 1 : 0);
      if (b < 0) continue;
      const std::int32_t lower = runs.of_point[a];
      const std::int32_t upper = runs.of_point[b];
      if (lower < 0 || upper < 0 || (lower == joined_lower && upper == joined_upper)) continue;
      if (!same(image.range[a], image.range[b])) continue;
      sets.join(lower, upper);
      joined_lower = lower;
      joined_upper = upper;
    }
  }
}

struct Extent {
  int points = 0;
  int rows = 0;
  int last_row = -1;
};

}  // namespace

int mark_clusters(const RangeImage& image, const SensorModel& sensor,
                  const SegmentationSettings& settings, std::vector<Label>& label,
                  std::vector<std::int32_t>& cluster) {
  const double limit_tangent = std::tan(radians(settings.cluster_angle_deg));
  const double slack = 3.0 * sensor.range_noise;
  const SameInRow same_in_row(image.columns, limit_tangent, slack);
  const Runs runs = make_runs(image, label, same_in_row);
  UnionFind sets(runs.row.size());
  join_seams(image, same_in_row, runs, sets);
  join_columns(image, sensor, runs, limit_tangent, slack, sets);

  std::vector<Extent> extent(runs.row.size());
  for (std::int32_t run = 0; run < runs.count(); ++run) {
    Extent& e = extent[sets.root(run)];
    e.points += runs.points[run];
    if (e.last_row != runs.row[run]) ++e.rows;
    e.last_row = runs.row[run];
  }

  int clusters = 0;
  std::vector<std::int32_t> cluster_of(runs.row.size(), -1);
  for (std::int32_t run = 0; run < runs.count(); ++run) {
    const std::int32_t root = sets.root(run);
    const Extent& e = extent[root];
    const bool large = e.points >= settings.cluster_min_points;
    const bool thin =
        e.points >= settings.thin_cluster_min_points && e.rows >= settings.thin_cluster_min_rows;
    // The root has the smallest index of its cluster, so it is numbered before its members.
    if (large || thin) cluster_of[run] = run == root ? clusters++ : cluster_of[root];
  }

  cluster.resize(image.size());
  for (std::size_t i = 0; i < image.size(); ++i) {
    const std::int32_t run = runs.of_point[i];
    cluster[i] = run < 0 ? -1 : cluster_of[run];
    if (cluster[i] >= 0) label[i] = Label::segment;
  }
  return clusters;
}

}  // namespace lego_loam_sc
