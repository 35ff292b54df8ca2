// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/beams.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/pose.hpp"
#include "core/text.hpp"
#include "sensor/storage_order.hpp"

namespace lego_loam_sc {
namespace {

// Near the sensor the elevation of an off-centre beam varies by a degree; a line of a sensor
// without fixed beams sweeps over tens of degrees.
constexpr double kMaxIqrDeg = 2.0;
constexpr std::size_t kMinPoints = 20;  // per beam, over all scans
constexpr std::size_t kMaxBeams = 256;

// Histogram of the elevations from -90 to 90 degrees.
constexpr double kBinDeg = 0.01;
constexpr int kBins = 18000;
// The points form lines when kFitShare of them lie within kNearShare of the spacing to a beam.
constexpr double kNearShare = 0.15;
constexpr double kFitShare = 0.8;

double elevation_deg(const Eigen::Vector3f& p) {
  return degrees(std::atan2(p.z(), std::hypot(p.x(), p.y())));
}

// The q-quantile; reorders the values.
double quantile(std::vector<double>& values, double q) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Converts labels in any numbering (-1 = none) to beams sorted by their median elevation.
Beams make_beams(std::span<const Scan> scans, const std::vector<std::vector<int>>& label_of_point) {
  std::map<int, std::vector<double>> elevations;  // of each label
  for (std::size_t s = 0; s < scans.size(); ++s)
    for (std::size_t i = 0; i < scans[s].size(); ++i)
      if (label_of_point[s][i] >= 0 && is_return(scans[s].points[i]))
        elevations[label_of_point[s][i]].push_back(elevation_deg(scans[s].points[i]));

  struct Measured {
    double median, iqr;
    int label;
  };
  std::vector<Measured> measured;
  for (auto& [label, values] : elevations)
    if (values.size() >= kMinPoints)
      measured.push_back(
          {quantile(values, 0.5), quantile(values, 0.75) - quantile(values, 0.25), label});
  std::ranges::sort(measured, {}, &Measured::median);

  Beams beams;
  std::map<int, std::int16_t> beam_of_label;
  for (const Measured& beam : measured) {
    beam_of_label[beam.label] = static_cast<std::int16_t>(beams.elevation_deg.size());
    beams.elevation_deg.push_back(beam.median);
    beams.iqr_deg.push_back(beam.iqr);
  }
  for (const std::vector<int>& labels : label_of_point) {
    std::vector<std::int16_t>& of_point = beams.of_point.emplace_back();
    for (const int label : labels) {
      const auto found = beam_of_label.find(label);
      of_point.push_back(found == beam_of_label.end() ? std::int16_t{-1} : found->second);
    }
  }
  return beams;
}

using Histogram = std::vector<double>;

Histogram histogram_of(std::span<const Scan> scans) {
  Histogram histogram(kBins, 0.0);
  for (const Scan& scan : scans)
    for (const Eigen::Vector3f& p : scan.points)
      if (is_return(p))
        ++histogram[std::clamp(static_cast<int>((elevation_deg(p) + 90.0) / kBinDeg), 0,
                               kBins - 1)];
  return histogram;
}

double centre_deg(double bin) {
  return (bin + 0.5) * kBinDeg - 90.0;
}

// Two passes of a moving average over 2 * reach + 1 bins.
Histogram smoothed(Histogram histogram, int reach) {
  for (int pass = 0; pass < 2; ++pass) {
    Histogram sums(kBins + 1, 0.0);
    std::partial_sum(histogram.begin(), histogram.end(), sums.begin() + 1);
    for (int bin = 0; bin < kBins; ++bin)
      histogram[bin] = (sums[std::min(bin + reach + 1, kBins)] - sums[std::max(bin - reach, 0)]) /
                       (2 * reach + 1);
  }
  return histogram;
}

// The bins of the peaks that are at least twice as high as the valleys beside them.
std::vector<int> peaks_of(const Histogram& histogram) {
  std::vector<int> peaks;
  int top = 0;     // since the last valley
  int valley = 0;  // lowest bin since the last peak
  for (int bin = 0; bin < kBins; ++bin) {
    if (histogram[bin] < histogram[valley]) valley = bin;
    if (histogram[bin] > histogram[top] ||
        (top <= valley && histogram[bin] > 0.0 && histogram[valley] <= 0.5 * histogram[bin]))
      top = bin;
    const bool falls = histogram[bin] <= 0.5 * histogram[top];
    if (falls && top > valley) {
      peaks.push_back(top);
      valley = top = bin;
    }
  }
  return peaks;
}

// Share of the points near a peak, relative to the spacing of the peaks there.
double share_near(const Histogram& histogram, const std::vector<int>& peaks) {
  double near = 0.0;
  for (std::size_t p = 0; p < peaks.size(); ++p) {
    const int below = p > 0 ? peaks[p] - peaks[p - 1] : peaks[1] - peaks[0];
    const int above = p + 1 < peaks.size() ? peaks[p + 1] - peaks[p] : below;
    const int first = std::max(peaks[p] - static_cast<int>(kNearShare * below), 0);
    const int last = std::min(peaks[p] + static_cast<int>(kNearShare * above), kBins - 1);
    near += std::accumulate(histogram.begin() + first, histogram.begin() + last + 1, 0.0);
  }
  return near / std::accumulate(histogram.begin(), histogram.end(), 0.0);
}

// Elevations half-way between beams, deg; empty when the points form no lines.
std::vector<double> find_borders(const Histogram& histogram) {
  // Too fine a scale splits off-centre beams, too coarse a scale merges beams.
  std::vector<int> best;
  double best_share = kFitShare;
  for (const int reach : {1, 2, 3, 5, 8, 13, 21, 34}) {
    std::vector<int> peaks = peaks_of(smoothed(histogram, reach));
    if (peaks.size() < 2 || peaks.size() > kMaxBeams) continue;
    const double share = share_near(histogram, peaks);
    if (share < best_share) continue;
    best_share = share + 0.01;  // for equal shares the finer scale wins
    best = std::move(peaks);
  }
  std::vector<double> borders;
  for (std::size_t p = 1; p < best.size(); ++p)
    borders.push_back(centre_deg(0.5 * (best[p - 1] + best[p])));
  return borders;
}

// Other storage orders yield groups that mix beams, whose elevations vary by the beam spacing.
bool are_rings(const Beams& beams) {
  const std::size_t count = beams.elevation_deg.size();
  if (count < 8 || count > kMaxBeams) return false;
  std::vector<double> iqr = beams.iqr_deg;
  const double spacing =
      (beams.elevation_deg.back() - beams.elevation_deg.front()) / static_cast<double>(count - 1);
  return quantile(iqr, 0.5) < 0.75 * spacing;
}

}  // namespace

std::vector<std::int16_t> stored_rings(const Scan& scan) {
  std::vector<std::uint8_t> returns(scan.size());
  std::ranges::transform(scan.points, returns.begin(), is_return);
  return rings_of_storage_order(scan, returns);
}

Beams beams_of_rings(std::span<const Scan> scans) {
  std::vector<std::vector<int>> labels;
  bool has_rings = false;
  for (const Scan& scan : scans) {
    labels.emplace_back(scan.size(), -1);
    std::ranges::copy(scan.ring, labels.back().begin());
    for (const std::uint16_t ring : scan.ring) has_rings |= ring != scan.ring.front();
  }
  return has_rings ? make_beams(scans, labels) : Beams{};
}

Beams beams_of_storage_order(std::span<const Scan> scans) {
  std::vector<std::vector<int>> labels;
  std::map<int, int> scans_by_rings;  // number of scans by number of rings
  std::vector<int> rings;
  for (const Scan& scan : scans) {
    const std::vector<std::int16_t> ring = stored_rings(scan);
    labels.emplace_back(ring.begin(), ring.end());
    labels.back().resize(scan.size(), -1);
    rings.push_back(ring.empty() ? 0 : 1 + *std::ranges::max_element(ring));
    ++scans_by_rings[rings.back()];
  }
  if (scans_by_rings.empty()) return {};
  // A missing ring shifts the numbers of all rings below it.
  const int most_common = std::ranges::max_element(scans_by_rings, {}, [](const auto& entry) {
                            return entry.second;
                          })->first;
  for (std::size_t s = 0; s < scans.size(); ++s)
    if (rings[s] != most_common) labels[s].assign(labels[s].size(), -1);

  const Beams beams = make_beams(scans, labels);
  return are_rings(beams) ? beams : Beams{};
}

Beams beams_of_elevations(std::span<const Scan> scans) {
  const std::vector<double> borders = find_borders(histogram_of(scans));
  if (borders.empty()) return {};
  std::vector<std::vector<int>> labels;
  for (const Scan& scan : scans) {
    labels.emplace_back(scan.size(), -1);
    for (std::size_t i = 0; i < scan.size(); ++i)
      if (is_return(scan.points[i]))
        labels.back()[i] = static_cast<int>(
            std::ranges::upper_bound(borders, elevation_deg(scan.points[i])) - borders.begin());
  }
  return make_beams(scans, labels);
}

std::optional<std::string> ring_fault(const Beams& rings) {
  std::vector<double> iqr = rings.iqr_deg;
  if (iqr.empty() || quantile(iqr, 0.5) <= kMaxIqrDeg) return std::nullopt;
  const auto widest = std::ranges::max_element(rings.iqr_deg);
  return "half of the points of one ring are spread over " + to_fixed(*widest, 1) +
         " degrees of elevation, so the ring field does not number beams: either the sensor does "
         "not "
         "spin (a Livox has no fixed beams), or the points were transformed into another frame; "
         "LeGO-LOAM-SC needs the points of a spinning LiDAR in its own frame";
}

}  // namespace lego_loam_sc
