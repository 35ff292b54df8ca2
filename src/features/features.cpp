// SPDX-License-Identifier: BSD-3-Clause
#include "features/features.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "features/roughness.hpp"

namespace lego_loam_sc {
namespace {

// A pair of neighbours whose ranges differ by more than this share on both sides of a point is seen
// at so flat an angle that the point says little (LOAM, section V-A).
constexpr float kParallelBeam = 0.02f;

enum class Pick : std::uint8_t { none, edge_large, edge_sharp, planar_large, planar_flat };

// The points of one row that segmentation kept.
struct Row {
  std::vector<std::uint32_t> index;  // into the image
  std::vector<float> range;
  std::vector<std::uint16_t> column;
  std::vector<Label> label;
  std::vector<float> roughness;
  std::vector<std::uint8_t> blocked;  // makes no feature
  std::vector<std::uint8_t> oblique;  // makes no edge
  std::vector<Pick> pick;

  int size() const { return static_cast<int>(index.size()); }
};

Row kept_points(const RangeImage& image, const Segmentation& segmentation, int row) {
  Row kept;
  for (std::uint32_t i = image.row_begin[row]; i < image.row_begin[row + 1]; ++i) {
    if (segmentation.label[i] == Label::outlier) continue;
    kept.index.push_back(i);
    kept.range.push_back(image.range[i]);
    kept.column.push_back(image.column[i]);
    kept.label.push_back(segmentation.label[i]);
  }
  kept.blocked.assign(kept.index.size(), 0);
  kept.oblique.assign(kept.index.size(), 0);
  kept.pick.assign(kept.index.size(), Pick::none);
  return kept;
}

// c_th: the setting, or what `noise_factor` sigmas of range noise make of a smooth surface. With |S|
// neighbours the sum of equation (1) has the variance sigma^2 (|S|^2 + |S|).
class Threshold {
 public:
  Threshold(const SensorModel& sensor, const FeatureSettings& settings)
      : wall_(static_cast<float>((settings.neighbours + 1) * (2 * settings.neighbours + 1)) / 6.0f),
        fixed_(static_cast<float>(settings.roughness_threshold)) {
    const double s = 2.0 * settings.neighbours;
    noise_metres_ = static_cast<float>(settings.noise_factor * sensor.range_noise *
                                       std::sqrt(s * s + s) / s);
  }

  float operator()(float range) const { return std::max(fixed_, noise_metres_ / range); }

  // A flat wall whose range changes by the share q from one beam to the next has a roughness of
  // q^2 (n + 1)(2 n + 1) / 6 with n neighbours on each side: above this q, less a margin, it would
  // pass for an edge, which travels along with the sensor.
  float oblique(float range) const { return 0.8f * std::sqrt((*this)(range) / wall_); }

 private:
  float wall_;  // roughness of a flat wall over q^2
  float fixed_;
  float noise_metres_;  // roughness times range
};

// The far side of a range jump may be partly hidden, so its border is no real edge; the near side
// is one. The row is taken as a line here: its two ends lie behind the vehicle.
void block_unreliable(const RangeImage& image, const FeatureSettings& settings,
                      const Threshold& threshold, Row& row) {
  const float step = 2.0f * std::numbers::pi_v<float> / static_cast<float>(image.columns);
  for (int i = 0; i + 1 < row.size(); ++i) {
    const float here = row.range[i];
    const float next = row.range[i + 1];
    if (row.column[i + 1] - row.column[i] < settings.max_column_gap) {
      const float gap = std::max(static_cast<float>(settings.occlusion_gap),
                                 3.0f * step * std::min(here, next));
      if (here - next > gap)
        for (int k = std::max(i - settings.neighbours, 0); k <= i; ++k) row.blocked[k] = 1;
      if (next - here > gap)
        for (int k = i + 1; k <= std::min(i + 1 + settings.neighbours, row.size() - 1); ++k)
          row.blocked[k] = 1;
    }
    if (i == 0) continue;
    const float share =
        std::min(std::abs(row.range[i - 1] - here), std::abs(next - here)) / here;
    if (share > kParallelBeam) row.blocked[i] = 1;
    if (share > threshold.oblique(here)) row.oblique[i] = 1;
  }
}

// Neighbours of a pick are the same edge or the same spot of a plane.
void suppress(int i, const FeatureSettings& settings, const Row& row,
              std::vector<std::uint8_t>& used) {
  used[i] = 1;
  for (const int direction : {-1, 1}) {
    for (int k = 1; k <= settings.suppressed_neighbours; ++k) {
      const int j = i + direction * k;
      if (j < 0 || j >= row.size()) break;
      if (std::abs(row.column[j] - row.column[j - direction]) > settings.max_column_gap) break;
      used[j] = 1;
    }
  }
}

using Ranked = std::vector<std::pair<float, int>>;  // roughness, position in the row

void pick_edges(Ranked& candidates, const FeatureSettings& settings, Row& row,
                std::vector<std::uint8_t>& used) {
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  int picked = 0;
  const int wanted = std::max(settings.edges_large, settings.edges_sharp);
  for (const auto& [c, i] : candidates) {
    if (picked == wanted) break;
    if (used[i]) continue;
    row.pick[i] = picked < settings.edges_sharp ? Pick::edge_sharp : Pick::edge_large;
    ++picked;
    suppress(i, settings, row, used);
  }
}

void pick_planars(Ranked& candidates, const FeatureSettings& settings, Row& row,
                  std::vector<std::uint8_t>& used) {
  // Each pick takes at most 2 x suppressed_neighbours others out, so this many of the flattest are
  // enough to make all picks.
  const int wanted = std::max(settings.planars_flat, settings.planars_large);
  const std::size_t enough = std::min<std::size_t>(
      candidates.size(), static_cast<std::size_t>(wanted) * (2 * settings.suppressed_neighbours + 1));
  if (enough == 0) return;
  std::nth_element(candidates.begin(), candidates.begin() + enough - 1, candidates.end());
  std::sort(candidates.begin(), candidates.begin() + enough);
  int flat = 0;
  int picked = 0;
  for (std::size_t k = 0; k < enough && picked < wanted; ++k) {
    const int i = candidates[k].second;
    if (used[i]) continue;
    const bool may_be_flat = !settings.flat_from_ground_only || row.label[i] == Label::ground;
    if (may_be_flat && flat < settings.planars_flat) {
      row.pick[i] = Pick::planar_flat;
      ++flat;
    } else if (settings.planars_large > 0) {
      row.pick[i] = Pick::planar_large;
    } else {
      continue;
    }
    ++picked;
    suppress(i, settings, row, used);
  }
}

// m from one point to the next along the row at i, which has all its neighbours. The point itself has
// no say: were the distance to the last pick measured, its noise would decide whether it is picked,
// and all walls would seem turned in the sense of the scan.
float local_step(const RangeImage& image, const FeatureSettings& settings, const Row& row, int i) {
  const int n = settings.neighbours;
  const auto point = [&](int k) { return image.points[row.index[(k + row.size()) % row.size()]]; };
  return (point(i + n) - point(i - n)).norm() / static_cast<float>(2 * n);
}

// The large planar set without a count: every smooth point, thinned along the row.
void spread_planars(const RangeImage& image, const std::vector<std::uint8_t>& smooth,
                    const FeatureSettings& settings, Row& row) {
  const auto spacing = static_cast<float>(settings.planar_spacing);
  int last = -row.size();
  for (int i = 0; i < row.size(); ++i) {
    const bool flat = row.pick[i] == Pick::planar_flat;
    if (!flat && (row.pick[i] != Pick::none || !smooth[i])) continue;
    const bool apart =
        static_cast<float>(i - last) * local_step(image, settings, row, i) >= spacing;
    if (!flat && !apart) continue;
    if (!flat) row.pick[i] = Pick::planar_large;
    last = i;
  }
}

void select(const RangeImage& image, const FeatureSettings& settings, const Threshold& threshold,
            Row& row) {
  std::vector<std::uint8_t> smooth(row.size(), 0);
  std::vector<std::uint8_t> used(row.blocked);
  int begin = 0;
  for (int part = 0; part < settings.sub_images; ++part) {
    const int last_column = (part + 1) * image.columns / settings.sub_images;
    Ranked edges, planars;
    int i = begin;
    for (; i < row.size() && row.column[i] < last_column; ++i) {
      const float c = row.roughness[i];
      if (std::isnan(c) || row.blocked[i]) continue;
      if (c > threshold(row.range[i])) {
        if (row.label[i] != Label::ground && !row.oblique[i]) edges.emplace_back(c, i);
      } else {
        smooth[i] = 1;
        if (settings.planars_large > 0 || !settings.flat_from_ground_only ||
            row.label[i] == Label::ground)
          planars.emplace_back(c, i);
      }
    }
    begin = i;
    pick_edges(edges, settings, row, used);
    pick_planars(planars, settings, row, used);
  }
  if (settings.planars_large == 0) spread_planars(image, smooth, settings, row);
}

void append(const RangeImage& image, int row_number, const Row& row, Features& features) {
  for (int i = 0; i < row.size(); ++i) {
    if (row.pick[i] == Pick::none) continue;
    const std::uint32_t k = row.index[i];
    const FeaturePoint point{image.points[k],
                             image.age[k],
                             image.intensity[k],
                             static_cast<std::uint16_t>(row_number),
                             row.column[i],
                             row.label[i]};
    switch (row.pick[i]) {
      case Pick::edge_sharp: features.edges_sharp.push_back(point); [[fallthrough]];
      case Pick::edge_large: features.edges_large.push_back(point); break;
      case Pick::planar_flat: features.planars_flat.push_back(point); [[fallthrough]];
      case Pick::planar_large: features.planars_large.push_back(point); break;
      case Pick::none: break;
    }
  }
}

Features extract(const RangeImage& image, const Segmentation& segmentation,
                 const SensorModel& sensor, const FeatureSettings& settings) {
  Features features;
  const Threshold threshold(sensor, settings);
  for (int row_number = 0; row_number < image.rows; ++row_number) {
    Row row = kept_points(image, segmentation, row_number);
    row.roughness = roughness(row.range, row.column, image.columns, settings.neighbours,
                              settings.max_column_gap);
    block_unreliable(image, settings, threshold, row);
    select(image, settings, threshold, row);
    append(image, row_number, row, features);
  }
  return features;
}

}  // namespace

Features extract_features(const RangeImage& image, const Segmentation& segmentation,
                          const SensorModel& sensor, const FeatureSettings& settings) {
  Features features = extract(image, segmentation, sensor, settings);
  if (!settings.flat_from_ground_only ||
      static_cast<int>(features.planars_flat.size()) >= settings.min_ground_flats)
    return features;
  FeatureSettings from_everywhere = settings;
  from_everywhere.flat_from_ground_only = false;
  return extract(image, segmentation, sensor, from_everywhere);
}

}  // namespace lego_loam_sc
