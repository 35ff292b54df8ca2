// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/scan_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

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

// The sweep lasts as long to either side of the reference time.
double span_of(const RangeImage& image) {
  float latest = 0.0F;
  for (const float time : image.time) latest = std::max(latest, time);
  return 2.0 * latest;
}

void scale_times(double factor, RangeImage& image) {
  if (factor == 1.0) return;
  for (float& time : image.time) time *= static_cast<float>(factor);
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
  scale_times(sweep_.factor(), image);
}

void ScanCheck::restart() {
  findings_ = {};
  sweep_.restart();
}

}  // namespace lego_loam_sc
