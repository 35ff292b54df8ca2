// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/row_assignment.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "core/pose.hpp"
#include "sensor/storage_order.hpp"

namespace lego_loam_sc {
namespace {

constexpr std::int16_t kNoRow = -1;

// The group of each point: a ring in arbitrary numbering, -1 for none.
struct Groups {
  std::vector<std::int16_t> of_point;
  int count = 0;
};

Groups groups_of_ring_field(const Scan& scan) {
  Groups groups;
  groups.of_point.assign(scan.size(), -1);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.ring[i] >= kMaxRings) continue;  // a corrupt field
    groups.of_point[i] = static_cast<std::int16_t>(scan.ring[i]);
    groups.count = std::max(groups.count, scan.ring[i] + 1);
  }
  return groups;
}

Groups groups_of_storage_order(const Scan& scan, const std::vector<std::uint8_t>& usable) {
  Groups groups;
  groups.of_point = rings_of_storage_order(scan, usable);
  if (!groups.of_point.empty())
    groups.count = 1 + *std::max_element(groups.of_point.begin(), groups.of_point.end());
  return groups;
}

// Mean elevation of each group, rad, over every n-th point; NaN for a group without points.
std::vector<double> mean_elevation_of_every(std::size_t n, const Scan& scan,
                                            const std::vector<std::uint8_t>& usable,
                                            const Groups& groups) {
  std::vector<double> sum(groups.count, 0.0);
  std::vector<int> count(groups.count, 0);
  for (std::size_t i = 0; i < scan.size(); i += n) {
    if (!usable[i] || groups.of_point[i] < 0) continue;
    const Eigen::Vector3f& p = scan.points[i];
    const float horizontal = std::sqrt(p.x() * p.x() + p.y() * p.y());
    if (horizontal == 0.0f) continue;
    sum[groups.of_point[i]] += p.z() / horizontal;
    ++count[groups.of_point[i]];
  }
  std::vector<double> mean(groups.count);
  for (int g = 0; g < groups.count; ++g)
    mean[g] =
        count[g] > 0 ? std::atan(sum[g] / count[g]) : std::numeric_limits<double>::quiet_NaN();
  return mean;
}

// In large scans every seventh point suffices, unless that skips a group.
std::vector<double> mean_elevation(const Scan& scan, const std::vector<std::uint8_t>& usable,
                                   const Groups& groups) {
  constexpr std::size_t kManyPoints = 20'000;
  if (scan.size() >= kManyPoints) {
    const std::vector<double> mean = mean_elevation_of_every(7, scan, usable, groups);
    if (std::ranges::none_of(mean, [](double m) { return std::isnan(m); })) return mean;
  }
  return mean_elevation_of_every(1, scan, usable, groups);
}

// Whether the points are stored ring by ring from the top: as many rings as beams (a few may be
// empty) with descending elevation.
bool is_storage_order(const std::vector<double>& elevation, const SensorModel& sensor) {
  const int groups = static_cast<int>(elevation.size());
  if (groups > sensor.rows() || 2 * groups < sensor.rows() || groups < 2) return false;
  int falling = 0;
  for (int g = 1; g < groups; ++g) falling += elevation[g] < elevation[g - 1];
  return falling >= 0.9 * (groups - 1);
}

std::vector<std::int16_t> rows_of_groups(const Groups& groups,
                                         const std::vector<std::int16_t>& row_of_group) {
  std::vector<std::int16_t> rows(groups.of_point.size(), kNoRow);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (groups.of_point[i] >= 0) rows[i] = row_of_group[groups.of_point[i]];
  return rows;
}

std::vector<std::int16_t> rows_of_elevation(const Scan& scan,
                                            const std::vector<std::uint8_t>& usable,
                                            const SensorModel& sensor) {
  // Tangents are compared. A point farther from its beam than half the spacing belongs to no row.
  const int count = sensor.rows();
  std::vector<double> upper(count), lower(count);
  for (int r = 0; r < count; ++r) {
    const double e = sensor.elevation_deg[r];
    const double above = r + 1 < count ? sensor.elevation_deg[r + 1] - e : 0.0;
    const double below = r > 0 ? e - sensor.elevation_deg[r - 1] : 0.0;
    upper[r] = std::tan(radians(e + 0.5 * (above > 0.0 ? above : std::max(below, 1.0))));
    lower[r] = std::tan(radians(e - 0.5 * (below > 0.0 ? below : std::max(above, 1.0))));
  }
  std::vector<std::int16_t> rows(scan.size(), kNoRow);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!usable[i]) continue;
    const Eigen::Vector3f& p = scan.points[i];
    const double tangent = p.z() / std::sqrt(p.x() * p.x() + p.y() * p.y());
    const auto row = std::upper_bound(upper.begin(), upper.end(), tangent) - upper.begin();
    if (row < count && tangent >= lower[row]) rows[i] = static_cast<std::int16_t>(row);
  }
  return rows;
}

}  // namespace

// By dynamic programming.
std::optional<std::vector<std::int16_t>> align_to_beams(const std::vector<double>& elevation,
                                                        const SensorModel& sensor) {
  std::vector<int> order;
  for (std::size_t g = 0; g < elevation.size(); ++g)
    if (!std::isnan(elevation[g])) order.push_back(static_cast<int>(g));
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return elevation[a] < elevation[b]; });
  const int groups = static_cast<int>(order.size());
  const int rows = sensor.rows();
  if (groups == 0 || groups > rows) return std::nullopt;

  const double infinity = std::numeric_limits<double>::infinity();
  // cost[g][r]: the first g groups assigned to the first r rows.
  std::vector<double> cost(static_cast<std::size_t>(groups + 1) * (rows + 1), infinity);
  const auto at = [&](int g, int r) -> double& { return cost[g * (rows + 1) + r]; };
  const auto difference = [&](int g, int r) {
    return std::abs(elevation[order[g]] - radians(sensor.elevation_deg[r]));
  };
  for (int r = 0; r <= rows; ++r) at(0, r) = 0.0;
  for (int g = 1; g <= groups; ++g)
    for (int r = g; r <= rows; ++r)
      at(g, r) = std::min(at(g, r - 1), at(g - 1, r - 1) + difference(g - 1, r - 1));

  std::vector<std::int16_t> row_of_group(elevation.size(), kNoRow);
  for (int g = groups, r = rows; g > 0; --r) {
    if (r > g && at(g, r) == at(g, r - 1)) continue;
    row_of_group[order[g - 1]] = static_cast<std::int16_t>(r - 1);
    --g;
  }
  return row_of_group;
}

std::vector<std::int16_t> assign_rows(const Scan& scan, const std::vector<std::uint8_t>& usable,
                                      const SensorModel& sensor) {
  const bool one_ring = std::adjacent_find(scan.ring.begin(), scan.ring.end(),
                                           std::not_equal_to<>()) == scan.ring.end();
  if (!one_ring) {  // a constant ring number is as good as none
    const Groups groups = groups_of_ring_field(scan);
    if (const auto rows = align_to_beams(mean_elevation(scan, usable, groups), sensor))
      return rows_of_groups(groups, *rows);
  } else {
    const Groups groups = groups_of_storage_order(scan, usable);
    const std::vector<double> elevation = mean_elevation(scan, usable, groups);
    if (is_storage_order(elevation, sensor))
      if (const auto rows = align_to_beams(elevation, sensor)) return rows_of_groups(groups, *rows);
  }
  return rows_of_elevation(scan, usable, sensor);
}

}  // namespace lego_loam_sc
