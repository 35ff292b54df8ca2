// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/scan_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "segmentation/isolated_returns.hpp"
#include "segmentation/remove_points.hpp"

namespace lego_loam_sc {
namespace {

// Removes what `marker` marks; returns the number of points.
template <class Marker>
std::size_t remove_marked(const Marker& marker, RangeImage& image) {
  std::vector<std::uint8_t> remove(image.size(), 0);
  const std::size_t count = marker.mark(image, remove);
  if (count > 0) remove_points(remove, image);
  return count;
}

// Few isolated returns do no harm: clean scans have 0.2 % of them, among trees 1 %.
constexpr double kLeastDust = 0.02;

std::size_t remove_dust(const SensorModel& sensor, RangeImage& image) {
  std::vector<std::uint8_t> remove(image.size(), 0);
  const std::size_t count = mark_isolated_returns(image, sensor, remove);
  if (static_cast<double>(count) < kLeastDust * static_cast<double>(image.size())) return 0;
  remove_points(remove, image);
  return count;
}

// The sweep lasts as long to either side of the reference time.
double span_of(const RangeImage& image) {
  float latest = 0.0F;
  for (const float age : image.age) latest = std::max(latest, age);
  return 2.0 * latest;
}

void scale_times(double factor, RangeImage& image) {
  if (factor == 1.0) return;
  for (float& age : image.age) age *= static_cast<float>(factor);
  const std::int64_t middle = image.reference_ns - image.stamp_ns;
  image.reference_ns = image.stamp_ns + std::llround(factor * static_cast<double>(middle));
}

}  // namespace

void ScanCheck::check(RangeImage& image) {
  findings_.points += image.size();
  sweep_.add(image.stamp_ns, span_of(image));
  filler_.observe(image);
  findings_.filler_points += remove_marked(filler_, image);
  body_.observe(image);
  findings_.body_points += remove_marked(body_, image);
  findings_.dust_points += remove_dust(sensor_, image);
  scale_times(sweep_.factor(), image);

  findings_.filler_range = filler_.range().value_or(findings_.filler_range);
  if (body_.size() > 0) findings_.body_range = body_.range();
  findings_.time_factor = sweep_.factor();
  findings_.long_sweeps = sweep_.too_long();
  findings_.sweeps = sweep_.compared();
}

void ScanCheck::correct(RangeImage& image) const {
  remove_marked(filler_, image);
  remove_marked(body_, image);
  remove_dust(sensor_, image);
  scale_times(sweep_.factor(), image);
}

void ScanCheck::restart() {
  findings_ = {};
  sweep_.restart();
}

}  // namespace lego_loam_sc
