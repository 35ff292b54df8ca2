// SPDX-License-Identifier: BSD-3-Clause
#include "features/features.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "features/feature_row.hpp"

namespace lego_loam_sc {
namespace {

// Neighbours of a pick belong to the same edge or the same patch of a plane.
void suppress(int i, const FeatureSettings& settings, FeatureRow& row) {
  row.used[i] = 1;
  for (const int direction : {-1, 1}) {
    for (int k = 1; k <= settings.suppressed_neighbours; ++k) {
      const int j = i + direction * k;
      if (j < 0 || j >= row.size()) break;
      if (row.gap_before[std::max(j, j - direction)]) break;
      row.used[j] = 1;
    }
  }
}

// Candidates of a row, each packed into one number that sorts by roughness, then by position in the
// row. Roughness is never negative, so its bits sort like its value.
using Ranked = std::vector<std::uint64_t>;

std::uint64_t smoothest_first(float roughness, int position) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(roughness)} << 32 |
         static_cast<std::uint32_t>(position);
}

std::uint64_t roughest_first(float roughness, int position) {
  return std::uint64_t{~std::bit_cast<std::uint32_t>(roughness)} << 32 |
         static_cast<std::uint32_t>(position);
}

// Calls visit(position) for the candidates in ascending order until it returns false. A heap, since
// few of many are visited.
template <class Visit>
void visit_in_order(Ranked& candidates, Visit&& visit) {
  std::make_heap(candidates.begin(), candidates.end(), std::greater<>());
  while (!candidates.empty()) {
    if (!visit(static_cast<int>(candidates.front() & 0xffffffff))) return;
    std::pop_heap(candidates.begin(), candidates.end(), std::greater<>());
    candidates.pop_back();
  }
}

void pick_edges(Ranked& candidates, const FeatureSettings& settings, FeatureRow& row) {
  int picked = 0;
  const int wanted = std::max(settings.edges_large, settings.edges_sharp);
  visit_in_order(candidates, [&](int i) {
    if (picked == wanted) return false;
    if (row.used[i]) return true;
    row.pick[i] = picked < settings.edges_sharp ? Pick::edge_sharp : Pick::edge_large;
    ++picked;
    suppress(i, settings, row);
    return true;
  });
}

void pick_planars(Ranked& candidates, const FeatureSettings& settings, FeatureRow& row) {
  // Each pick suppresses at most 2 x suppressed_neighbours others, so this many of the flattest
  // candidates suffice.
  const int wanted = std::max(settings.planars_flat, settings.planars_large);
  int left = wanted * (2 * settings.suppressed_neighbours + 1);
  int flat = 0;
  int picked = 0;
  visit_in_order(candidates, [&](int i) {
    if (picked == wanted || left-- == 0) return false;
    if (row.used[i]) return true;
    const bool may_be_flat = !settings.flat_from_ground_only || row.label[i] == Label::ground;
    if (may_be_flat && flat < settings.planars_flat) {
      row.pick[i] = Pick::planar_flat;
      ++flat;
    } else if (settings.planars_large > 0) {
      row.pick[i] = Pick::planar_large;
    } else {
      return true;
    }
    ++picked;
    suppress(i, settings, row);
    return true;
  });
}

// Whether `steps` points along the row at i span at least `planar_spacing`. The step is the mean
// over the neighbours of i, so that the point's own noise does not bias the selection: with the
// distance to the last pick, all walls would appear rotated in the direction of the scan.
bool is_spaced(const RangeImage& image, const FeatureSettings& settings, const FeatureRow& row,
               int i, int steps) {
  const int n = settings.neighbours;
  const int count = row.size();
  const int before = i - n < 0 ? i - n + count : i - n;
  const int after = i + n >= count ? i + n - count : i + n;
  const float squared =
      (image.points[row.index[after]] - image.points[row.index[before]]).squaredNorm();
  const auto share = static_cast<float>(steps) / static_cast<float>(2 * n);
  const auto spacing = static_cast<float>(settings.planar_spacing);
  return share * share * squared >= spacing * spacing;
}

// The large planar set without an upper count: all smooth points, subsampled along the row.
void pick_spaced_planars(const RangeImage& image, const FeatureSettings& settings,
                         FeatureRow& row) {
  int last = -row.size();
  for (int i = 0; i < row.size(); ++i) {
    const bool flat = row.pick[i] == Pick::planar_flat;
    if (!flat && (row.pick[i] != Pick::none || !row.smooth[i])) continue;
    if (!flat && !is_spaced(image, settings, row, i, i - last)) continue;
    if (!flat) row.pick[i] = Pick::planar_large;
    last = i;
  }
}

// `edges` and `planars` are buffers for the candidates.
void select(const RangeImage& image, const FeatureSettings& settings, FeatureRow& row,
            Ranked& edges, Ranked& planars) {
  row.smooth.assign(row.size(), 0);
  row.used = row.blocked;
  const bool any_planar = settings.planars_large > 0 || !settings.flat_from_ground_only;
  int i = 0;
  for (int part = 0; part < settings.sub_images; ++part) {
    const int last_column = (part + 1) * image.columns / settings.sub_images;
    edges.clear();
    planars.clear();
    for (; i < row.size() && row.column[i] < last_column; ++i) {
      const float c = row.roughness[i];
      if (std::isnan(c) || row.blocked[i]) continue;
      if (c > row.threshold[i]) {
        if (row.label[i] != Label::ground && !row.oblique[i]) edges.push_back(roughest_first(c, i));
      } else {
        row.smooth[i] = 1;
        if (any_planar || row.label[i] == Label::ground) planars.push_back(smoothest_first(c, i));
      }
    }
    pick_edges(edges, settings, row);
    pick_planars(planars, settings, row);
  }
  if (settings.planars_large == 0) pick_spaced_planars(image, settings, row);
}

FeaturePoint feature_point(const RangeImage& image, int row, std::uint32_t k, Label label) {
  return {image.points[k], image.time[k], image.intensity[k], static_cast<std::uint16_t>(row),
          image.column[k], label};
}

void append(const RangeImage& image, int row_number, const FeatureRow& row, Features& features) {
  for (int i = 0; i < row.size(); ++i) {
    if (row.pick[i] == Pick::none) continue;
    const std::uint32_t k = row.index[i];
    const FeaturePoint point = feature_point(image, row_number, k, row.label[i]);
    switch (row.pick[i]) {
      case Pick::edge_sharp: features.edges_sharp.push_back(point); [[fallthrough]];
      case Pick::edge_large: features.edges_large.push_back(point); break;
      case Pick::planar_flat: features.planars_flat.push_back(point); [[fallthrough]];
      case Pick::planar_large: features.planars_large.push_back(point); break;
      case Pick::none: break;
    }
  }
}

// Fills `smooth` with one flag per point of the image.
Features extract(const RangeImage& image, const Segmentation& segmentation,
                 const SensorModel& sensor, const FeatureSettings& settings,
                 std::vector<std::uint8_t>& smooth) {
  Features features;
  smooth.assign(image.size(), 0);
  const RoughnessThreshold threshold(sensor, settings);
  FeatureRow row;
  Ranked edges, planars;
  for (int number = 0; number < image.rows; ++number) {
    row.load(image, segmentation, number, settings, threshold);
    select(image, settings, row, edges, planars);
    append(image, number, row, features);
    for (int i = 0; i < row.size(); ++i) smooth[row.index[i]] = row.smooth[i];
  }
  return features;
}

// All points above the ground except smooth surfaces, thinned along each row: along a smooth
// surface its points are arbitrary, and their pattern moves with the sensor.
std::vector<FeaturePoint> scattered_points(const RangeImage& image,
                                           const Segmentation& segmentation,
                                           const std::vector<std::uint8_t>& smooth,
                                           double spacing) {
  const auto min_squared = static_cast<float>(spacing * spacing);
  std::vector<FeaturePoint> points;
  for (int row = 0; row < image.rows; ++row) {
    Eigen::Vector3f last = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
    for (std::uint32_t i = image.row_begin[row]; i < image.row_begin[row + 1]; ++i) {
      if (segmentation.label[i] == Label::ground || smooth[i] ||
          (image.points[i] - last).squaredNorm() < min_squared)
        continue;
      last = image.points[i];
      points.push_back(feature_point(image, row, i, segmentation.label[i]));
    }
  }
  return points;
}

Features extract_edges_and_planars(const RangeImage& image, const Segmentation& segmentation,
                                   const SensorModel& sensor, const FeatureSettings& settings,
                                   std::vector<std::uint8_t>& smooth) {
  Features features = extract(image, segmentation, sensor, settings, smooth);
  if (!settings.flat_from_ground_only ||
      static_cast<int>(features.planars_flat.size()) >= settings.min_ground_flats)
    return features;
  FeatureSettings from_everywhere = settings;
  from_everywhere.flat_from_ground_only = false;
  return extract(image, segmentation, sensor, from_everywhere, smooth);
}

}  // namespace

std::vector<FeaturePoint> subsample(const std::vector<FeaturePoint>& points, int count) {
  const auto wanted = static_cast<std::size_t>(count);
  if (points.size() <= wanted) return points;
  std::vector<FeaturePoint> taken(wanted);
  for (std::size_t i = 0; i < wanted; ++i) taken[i] = points[i * points.size() / wanted];
  return taken;
}

Features extract_features(const RangeImage& image, const Segmentation& segmentation,
                          const SensorModel& sensor, const FeatureSettings& settings) {
  std::vector<std::uint8_t> smooth;
  Features features = extract_edges_and_planars(image, segmentation, sensor, settings, smooth);
  if (settings.scattered > 0)
    features.scattered = subsample(
        scattered_points(image, segmentation, smooth, settings.planar_spacing), settings.scattered);
  return features;
}

}  // namespace lego_loam_sc
