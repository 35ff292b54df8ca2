// SPDX-License-Identifier: BSD-3-Clause
#include "features/feature_row.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "features/roughness.hpp"

namespace lego_loam_sc {
namespace {

// A surface is nearly parallel to the beam, and its points are unreliable, when the relative range
// change on both sides exceeds this (LOAM, section V-A).
constexpr float kParallelBeam = 0.02f;

void resize(std::size_t size, FeatureRow& row) {
  row.index.resize(size);
  row.range.resize(size);
  row.column.resize(size);
  row.label.resize(size);
}

void load_kept_points(const RangeImage& image, const Segmentation& segmentation, int number,
                      FeatureRow& row) {
  const std::uint32_t begin = image.row_begin[number];
  const std::uint32_t end = image.row_begin[number + 1];
  resize(end - begin, row);
  std::size_t count = 0;
  for (std::uint32_t i = begin; i < end; ++i) {
    row.index[count] = i;
    row.range[count] = image.range[i];
    row.column[count] = image.column[i];
    row.label[count] = segmentation.label[i];
    count += segmentation.label[i] != Label::outlier;
  }
  resize(count, row);
}

// The ground is one surface, so wider gaps in it separate no objects.
void find_gaps(const RangeImage& image, const FeatureSettings& settings, FeatureRow& row) {
  const int count = row.size();
  row.gap_before.resize(count);
  for (int i = 0; i < count; ++i) {
    const int before = i == 0 ? count - 1 : i - 1;
    const int step = row.column[i] - row.column[before] + (i == 0 ? image.columns : 0);
    const bool ground = row.label[i] == Label::ground && row.label[before] == Label::ground;
    const int widest = ground ? settings.max_ground_gap : settings.max_column_gap;
    row.gap_before[i] = step > widest * image.column_step;
  }
}

// Marks points seen at a grazing angle; unknown, and so not marked, at the ends of the row.
void mark_grazing_points(const RoughnessThreshold& threshold, FeatureRow& row) {
  const int count = row.size();
  row.threshold.resize(count);
  for (int i = 0; i < count; ++i) row.threshold[i] = threshold(row.range[i]);
  row.blocked.assign(count, 0);
  row.oblique.assign(count, 0);
  // Plain pointers: writing a byte through a vector could alias the vector itself, which prevents
  // vectorisation.
  const float* range = row.range.data();
  const float* c_th = row.threshold.data();
  std::uint8_t* blocked = row.blocked.data();
  std::uint8_t* oblique = row.oblique.data();
  for (int i = 1; i + 1 < count; ++i) {
    const float before = std::abs(range[i - 1] - range[i]);
    const float after = std::abs(range[i + 1] - range[i]);
    const float share = std::min(before, after) / range[i];
    blocked[i] = share > kParallelBeam;
    oblique[i] = share > threshold.max_edge_obliqueness(c_th[i]);
  }
}

// The far side of a range jump may be partly occluded, so its border is no real edge; the near side
// is one. The row is treated as open here, since its ends lie behind the vehicle.
void block_occluded(const RangeImage& image, const FeatureSettings& settings, FeatureRow& row) {
  const float step = 2.0f * std::numbers::pi_v<float> / static_cast<float>(image.columns);
  const auto occlusion_gap = static_cast<float>(settings.occlusion_gap);
  for (int i = 0; i + 1 < row.size(); ++i) {
    const float here = row.range[i];
    const float next = row.range[i + 1];
    const float gap = std::max(occlusion_gap, 3.0f * step * std::min(here, next));
    if (std::abs(here - next) <= gap) continue;
    if (row.gap_before[i + 1]) continue;
    const bool far_side_ends = here > next;
    const int first = far_side_ends ? std::max(i - settings.neighbours, 0) : i + 1;
    const int last = far_side_ends ? i : std::min(i + 1 + settings.neighbours, row.size() - 1);
    for (int k = first; k <= last; ++k) row.blocked[k] = 1;
  }
}

}  // namespace

RoughnessThreshold::RoughnessThreshold(const SensorModel& sensor, const FeatureSettings& settings)
    : wall_(static_cast<float>((settings.neighbours + 1) * (2 * settings.neighbours + 1)) / 6.0f),
      fixed_(static_cast<float>(settings.roughness_threshold)) {
  const double s = 2.0 * settings.neighbours;
  noise_metres_ =
      static_cast<float>(settings.noise_factor * sensor.range_noise * std::sqrt(s * s + s) / s);
}

void FeatureRow::load(const RangeImage& image, const Segmentation& segmentation, int number,
                      const FeatureSettings& settings, const RoughnessThreshold& c_th) {
  load_kept_points(image, segmentation, number, *this);
  find_gaps(image, settings, *this);
  roughness = lego_loam_sc::roughness(range, gap_before, settings.neighbours);
  mark_grazing_points(c_th, *this);
  block_occluded(image, settings, *this);
  pick.assign(index.size(), Pick::none);
}

}  // namespace lego_loam_sc
