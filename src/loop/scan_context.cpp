// SPDX-License-Identifier: BSD-3-Clause
#include "loop/scan_context.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/azimuth.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// The bins of equation (3), sector by sector: the largest height above the ground in each, equation
// (2). Heights below the ground count as 0, so that a full bin is never below an empty one.
std::vector<float> bin_heights(std::span<const Eigen::Vector3f> points, double sensor_height,
                               const ScanContextSettings& settings) {
  std::vector<float> bins(static_cast<std::size_t>(settings.rings) * settings.sectors, 0.0f);
  const auto max_radius = static_cast<float>(settings.max_radius);
  const double rings_per_metre = settings.rings / settings.max_radius;
  const double sectors_per_radian = settings.sectors / kTurn;
  for (const Eigen::Vector3f& p : points) {
    const float radius = p.head<2>().norm();
    if (!(radius > 0.0f && radius < max_radius) || !std::isfinite(p.z())) continue;
    const float azimuth = fast_atan2(p.y(), p.x());
    const int ring = std::min(static_cast<int>(radius * rings_per_metre), settings.rings - 1);
    const int sector = std::min(
        static_cast<int>((azimuth < 0.0f ? azimuth + kTurn : azimuth) * sectors_per_radian),
        settings.sectors - 1);
    float& bin = bins[static_cast<std::size_t>(sector) * settings.rings + ring];
    bin = std::max(bin, static_cast<float>(p.z() + sensor_height));
  }
  return bins;
}

// Sum of a[i] b[i]. Partial sums, added in a fixed order, let the compiler use vectors of any width
// with the same result; there are enough of them to hide the latency of an addition.
float dot(const float* a, const float* b, std::size_t size) {
  constexpr std::size_t kLanes = 32;
  float lanes[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= size; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += a[i + lane] * b[i + lane];
  for (std::size_t lane = 0; i < size; ++lane, ++i) lanes[lane] += a[i] * b[i];
  for (std::size_t half = kLanes / 2; half > 0; half /= 2)
    for (std::size_t lane = 0; lane < half; ++lane) lanes[lane] += lanes[lane + half];
  return lanes[0];
}

// result[n] = sum over j of query[j] . candidate[j - n], with indices modulo the number of sectors:
// the candidate is shifted by n columns.
std::vector<float> correlate(const std::vector<float>& query, const std::vector<float>& candidate,
                             int sectors) {
  const std::size_t rings = query.size() / sectors;
  std::vector<float> query_twice = query;  // saves the modulo
  query_twice.insert(query_twice.end(), query.begin(), query.end());
  std::vector<float> result(sectors);
  for (int n = 0; n < sectors; ++n)
    result[n] = dot(query_twice.data() + n * rings, candidate.data(), candidate.size());
  return result;
}

// Equation (4) for all shifts of the candidate at once. Its cosine is undefined for a column
// without heights. Where both are empty there is nothing to compare, and the column does not
// count; where one is empty the two disagree, distance 1. When less than half of the circle can
// be compared, the distance is 1 as a whole: a few columns agree by chance.
std::vector<double> distances(const ScanContext& query, const ScanContext& candidate) {
  const std::vector<float> cosines = correlate(query.columns, candidate.columns, query.sectors);
  const std::vector<float> common = correlate(query.occupied, candidate.occupied, query.sectors);
  const auto count = [](const std::vector<float>& occupied) {
    return std::count(occupied.begin(), occupied.end(), 1.0f);
  };
  const auto occupied = static_cast<double>(count(query.occupied) + count(candidate.occupied));
  std::vector<double> result(query.sectors, 1.0);
  for (int n = 0; n < query.sectors; ++n) {
    if (2.0f * common[n] < static_cast<float>(query.sectors)) continue;
    const double compared = occupied - common[n];
    result[n] = std::clamp(1.0 - cosines[n] / compared, 0.0, 1.0);
  }
  return result;
}

// Where between -1/2 and 1/2 a parabola through three neighbours has its minimum.
double vertex(double before, double lowest, double after) {
  const double curvature = before - 2.0 * lowest + after;
  return curvature > 0.0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0.0;
}

}  // namespace

ScanContext make_scan_context(std::span<const Eigen::Vector3f> points, double sensor_height,
                              const ScanContextSettings& settings) {
  ScanContext context;
  context.rings = settings.rings;
  context.sectors = settings.sectors;
  context.columns = bin_heights(points, sensor_height, settings);
  context.occupied.assign(settings.sectors, 0.0f);

  std::vector<double> ring_sums(settings.rings, 0.0);
  for (int sector = 0; sector < settings.sectors; ++sector) {
    const std::span column(
        context.columns.data() + static_cast<std::size_t>(sector) * settings.rings, settings.rings);
    double squared_norm = 0.0;
    for (int ring = 0; ring < settings.rings; ++ring) {
      ring_sums[ring] += column[ring];
      squared_norm += static_cast<double>(column[ring]) * column[ring];
    }
    if (squared_norm == 0.0) continue;
    context.occupied[sector] = 1.0f;
    for (float& bin : column) bin = static_cast<float>(bin / std::sqrt(squared_norm));
  }

  // Equation (7) with the mean of a ring as psi.
  for (const double sum : ring_sums)
    context.ring_key.push_back(static_cast<float>(sum / settings.sectors));
  return context;
}

ScanContextMatch compare(const ScanContext& query, const ScanContext& candidate) {
  const int sectors = query.sectors;
  const std::vector<double> d = distances(query, candidate);
  const auto lowest = std::min_element(d.begin(), d.end());
  ScanContextMatch match;
  match.distance = *lowest;                            // equation (5)
  match.shift = static_cast<int>(lowest - d.begin());  // equation (6)

  // What the candidate sees at azimuth a, the query sees at a plus the shift: p_q = R_z(shift) p_c.
  const double shift = match.shift + vertex(d[(match.shift + sectors - 1) % sectors],
                                            match.distance, d[(match.shift + 1) % sectors]);
  match.yaw = std::remainder((sectors - shift) * kTurn / sectors, kTurn);
  return match;
}

}  // namespace lego_loam_sc
