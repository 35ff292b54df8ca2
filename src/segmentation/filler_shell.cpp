// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/filler_shell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/pose.hpp"

namespace lego_loam_sc {
namespace {

// Half the thickness of the shell in sigmas of the range, and the least one, m: drivers round.
constexpr double kSigmas = 4.0;
constexpr double kLeastHalfWidth = 0.03;
// A shell that holds fewer of the points does no harm.
constexpr double kLeastShare = 0.01;
constexpr int kLeastPoints = 100;
// Surfaces are at all ranges: a shell stands out of those around it by this factor.
constexpr int kAround = 5;  // shells to either side
constexpr int kContrast = 6;
// The directions of the points: at most this share in one row, and at least so many of the sectors
// of the azimuth.
constexpr double kRowShare = 0.5;
constexpr int kSectors = 36;
constexpr int kLeastSectors = 9;
// An upright cylinder of this radius would change its range over the rows by so many thicknesses.
constexpr double kCylinderWidths = 2.0;
// Scans in a row that make it known.
constexpr int kKnown = 3;

}  // namespace

FillerShell::FillerShell(const SensorModel& sensor)
    : elevation_deg_(sensor.elevation_deg),
      half_width_(static_cast<float>(std::max(kSigmas * sensor.range_noise, kLeastHalfWidth))) {}

std::optional<double> FillerShell::range() const {
  if (scans_ < kKnown) return std::nullopt;
  return range_;
}

void FillerShell::observe(const RangeImage& image) {
  if (scans_ >= kKnown) return;
  const std::optional<float> shell = find(image);
  shown_ = shell.has_value();
  if (!shown_) {
    scans_ = 0;
    return;
  }
  const bool same = scans_ > 0 && std::abs(*shell - range_) < half_width_;
  scans_ = same ? scans_ + 1 : 1;
  range_ = same ? range_ + (*shell - range_) / static_cast<float>(scans_) : *shell;
}

std::size_t FillerShell::mark(const RangeImage& image, std::vector<std::uint8_t>& remove) const {
  if (!shown_) return 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const bool filler = std::abs(image.range[i] - range_) < half_width_;
    remove[i] |= filler;
    count += filler;
  }
  return count;
}

// The shell that stands out most, when it is a sphere.
std::optional<float> FillerShell::find(const RangeImage& image) const {
  if (image.size() == 0) return std::nullopt;
  // Two bins make a shell, so that no border splits it.
  const float bins_per_metre = 1.0F / half_width_;
  const float farthest = *std::ranges::max_element(image.range);
  const int pad = 2 * kAround + 2;
  std::vector<int> bins(static_cast<std::size_t>(farthest * bins_per_metre) + 1 + 2 * pad, 0);
  for (const float range : image.range) ++bins[pad + static_cast<int>(range * bins_per_metre)];
  const int least =
      std::max(kLeastPoints, static_cast<int>(kLeastShare * static_cast<double>(image.size())));
  int best = 0;
  int most = 0;
  for (int k = pad; k + pad < static_cast<int>(bins.size()); ++k) {
    const int count = bins[k] + bins[k + 1];
    if (count <= most) continue;
    int around = 0;
    for (int d = 2; d < 2 + 2 * kAround; ++d) around += bins[k - d + 1] + bins[k + d];
    // The bins next to the two may hold the ends of the shell.
    around -= bins[k - 1] + bins[k + 2];
    if (count < least || count * (4 * kAround - 2) < kContrast * 2 * around) continue;
    best = k;
    most = count;
  }
  if (most == 0) return std::nullopt;

  const float low = static_cast<float>(best - pad) * half_width_;
  double sum = 0.0;
  int count = 0;
  for (const float range : image.range) {
    if (range < low || range >= low + 2.0F * half_width_) continue;
    sum += range;
    ++count;
  }
  const auto range = static_cast<float>(sum / std::max(count, 1));
  if (!is_sphere(image, range, count)) return std::nullopt;
  return range;
}

bool FillerShell::is_sphere(const RangeImage& image, float range, int count) const {
  std::vector<int> in_row(image.rows, 0);
  std::array<int, kSectors> in_sector{};
  for (int row = 0; row < image.rows; ++row) {
    for (std::uint32_t i = image.row_begin[row]; i < image.row_begin[row + 1]; ++i) {
      if (std::abs(image.range[i] - range) >= half_width_) continue;
      ++in_row[row];
      ++in_sector[image.column[i] * kSectors / image.columns];
    }
  }
  if (*std::ranges::max_element(in_row) > kRowShare * count) return false;
  if (std::ranges::count_if(in_sector, [&](int n) { return 4 * kSectors * n > count; }) <
      kLeastSectors)
    return false;
  // 10 and 90 % of the points by how far their beams are from the horizontal.
  std::vector<std::pair<double, int>> beams;
  for (int row = 0; row < image.rows; ++row)
    beams.emplace_back(std::abs(elevation_deg_[row]), in_row[row]);
  std::ranges::sort(beams);
  const auto elevation_of = [&](double share) {
    double below = 0.0;
    for (const auto& [elevation, points] : beams)
      if ((below += points) >= share * count) return radians(elevation);
    return radians(beams.back().first);
  };
  const double change = range / std::cos(elevation_of(0.9)) - range / std::cos(elevation_of(0.1));
  return change > kCylinderWidths * 2.0 * half_width_;
}

}  // namespace lego_loam_sc
