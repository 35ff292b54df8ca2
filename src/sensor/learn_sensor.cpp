// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/learn_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/text.hpp"
#include "core/time.hpp"
#include "sensor/beams.hpp"
#include "sensor/recognise_sensor.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kMaxBlindRange =
    1.0;  // m; larger minimum ranges are the scene's, not the sensor's

double azimuth_of(const Eigen::Vector3f& p) {
  return std::atan2(p.y(), p.x());
}

// Between -pi and pi.
double wrapped(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

std::size_t count_returns(std::span<const Scan> scans) {
  std::size_t count = 0;
  for (const Scan& scan : scans)
    count += static_cast<std::size_t>(std::ranges::count_if(scan.points, is_return));
  return count;
}

Beams find_beams(std::span<const Scan> scans, std::vector<std::string>& notes) {
  Beams beams = beams_of_rings(scans);
  if (const auto fault = ring_fault(beams)) throw InputError(*fault);
  std::string source = "the ring numbers";
  if (beams.empty()) {
    beams = beams_of_storage_order(scans);
    source = "the storage order, ring after ring";
  }
  if (beams.empty()) {
    beams = beams_of_elevations(scans);
    source = "the elevations of the points";
  }
  if (beams.empty())
    throw InputError(
        std::to_string(count_returns(scans)) +
        " points without ring numbers form no lines of constant elevation: either the sensor does "
        "not spin (a Livox or solid-state LiDAR has no rings), or the points were transformed; "
        "give the scans as the driver wrote them, with their ring numbers");
  for (double& elevation : beams.elevation_deg) elevation = std::round(1e3 * elevation) / 1e3;
  notes.push_back(std::to_string(beams.elevation_deg.size()) + " beams between " +
                  to_fixed(beams.elevation_deg.front(), 2) + " and " +
                  to_fixed(beams.elevation_deg.back(), 2) + " degrees, by " + source);
  return beams;
}

// The mean azimuth step from one point of a beam to the next without gaps, rad; nothing when there
// are too few points.
std::optional<double> azimuth_step(std::span<const Scan> scans, const Beams& beams) {
  constexpr double kSameDirection = 1e-4;  // rad; two returns of one shot
  std::vector<double> steps;
  for (std::size_t s = 0; s < scans.size(); ++s) {
    std::vector<std::pair<int, double>> order;  // beam, azimuth
    for (std::size_t i = 0; i < scans[s].size(); ++i)
      if (beams.of_point[s][i] >= 0 && is_return(scans[s].points[i]))
        order.emplace_back(beams.of_point[s][i], azimuth_of(scans[s].points[i]));
    std::ranges::sort(order);
    for (std::size_t k = 1; k < order.size(); ++k)
      if (order[k].first == order[k - 1].first &&
          order[k].second - order[k - 1].second > kSameDirection)
        steps.push_back(order[k].second - order[k - 1].second);
  }
  if (steps.size() < 100) return std::nullopt;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double median = *middle;
  double sum = 0.0;
  std::size_t count = 0;
  for (const double step : steps) {
    if (std::abs(step - median) > 0.25 * median) continue;  // a gap
    sum += step;
    ++count;
  }
  return sum / static_cast<double>(count);
}

void learn_columns(std::span<const Scan> scans, const Beams& beams, LearnedSensor& learned) {
  const std::optional<double> step = azimuth_step(scans, beams);
  if (!step) {
    learned.notes.emplace_back("too few points to determine the columns, 1800 are assumed");
    return;
  }
  learned.sensor.columns =
      std::clamp(static_cast<int>(std::lround(2.0 * std::numbers::pi / *step)), 36, 16384);
  learned.notes.push_back(to_fixed(degrees(*step), 3) + " degrees from column to column, " +
                          std::to_string(learned.sensor.columns) + " columns");
}

void learn_ranges(std::span<const Scan> scans, LearnedSensor& learned) {
  constexpr std::size_t kStrays = 20;  // the closest returns, which may be dust
  std::vector<float> ranges;
  for (const Scan& scan : scans)
    for (const Eigen::Vector3f& p : scan.points)
      if (is_return(p)) ranges.push_back(p.norm());
  const auto near =
      ranges.begin() + static_cast<std::ptrdiff_t>(std::min(kStrays, ranges.size() - 1));
  std::nth_element(ranges.begin(), near, ranges.end());
  const double nearest = *near;
  const double farthest = *std::ranges::max_element(ranges);
  SensorModel& sensor = learned.sensor;
  sensor.min_range = std::clamp(std::floor(10.0 * nearest) / 10.0, 0.1, kMaxBlindRange);
  // A short farthest return does not bound the maximum range.
  sensor.max_range = std::clamp(10.0 * std::ceil(farthest / 10.0), sensor.max_range, 1000.0);
  learned.notes.push_back(
      "ranges from " + to_fixed(nearest, 2) + " to " + to_fixed(farthest, 1) + " m seen" +
      (nearest > kMaxBlindRange ? "; no return was close enough to show the blind zone"
                                : std::string()));
}

// Start and direction of the sweep, from the points of each beam in order of time.
void learn_rotation(const Scan& scan, const std::vector<std::int16_t>& beam_of_point,
                    LearnedSensor& learned) {
  struct Timed {
    int beam;
    std::int32_t offset_ns;
    double azimuth;
  };
  std::vector<Timed> order;
  for (std::size_t i = 0; i < scan.offset_ns.size(); ++i)
    if (beam_of_point[i] >= 0 && is_return(scan.points[i]))
      order.push_back({beam_of_point[i], scan.offset_ns[i], azimuth_of(scan.points[i])});
  if (order.empty()) {
    learned.notes.emplace_back(
        "the points have no times: start_azimuth_deg and clockwise are assumed");
    return;
  }
  std::ranges::sort(order, {}, [](const Timed& t) { return std::pair(t.beam, t.offset_ns); });
  std::ptrdiff_t left = 0;
  for (std::size_t k = 1; k < order.size(); ++k)
    if (order[k].beam == order[k - 1].beam)
      left += wrapped(order[k].azimuth - order[k - 1].azimuth) > 0.0 ? 1 : -1;
  learned.sensor.clockwise = left < 0;
  const Timed& first = *std::ranges::min_element(order, {}, &Timed::offset_ns);
  learned.sensor.start_azimuth_deg = std::round(degrees(first.azimuth));
  learned.notes.push_back(std::string("turns ") + (left < 0 ? "clockwise" : "counter-clockwise") +
                          " from " + to_text(learned.sensor.start_azimuth_deg) + " degrees");
}

void learn_period(std::span<const Scan> scans, LearnedSensor& learned) {
  std::vector<double> gaps;  // s
  for (std::size_t s = 1; s < scans.size(); ++s)
    gaps.push_back(seconds(scans[s].stamp_ns - scans[s - 1].stamp_ns));
  if (gaps.empty()) return;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  if (*middle >= 0.02 && *middle <= 0.5) learned.sensor.period = std::round(1e3 * *middle) / 1e3;
}

}  // namespace

LearnedSensor learn_sensor(std::span<const Scan> scans, std::span<const SensorModel> presets) {
  if (count_returns(scans) < 1000)
    throw InputError("the scans have " + std::to_string(count_returns(scans)) +
                     " points with a return, too few to learn a sensor from");
  LearnedSensor learned;
  const Beams beams = find_beams(scans, learned.notes);
  learned.sensor.elevation_deg = beams.elevation_deg;
  learn_columns(scans, beams, learned);
  learn_ranges(scans, learned);
  learn_rotation(scans.front(), beams.of_point.front(), learned);
  learn_period(scans, learned);
  if (const auto preset = nearest_preset(beams.elevation_deg, presets))
    learned.notes.push_back("the nearest preset is " + preset->name + ", " +
                            to_fixed(preset->difference_deg, 3) + " degrees off on average");
  if (const auto fault = validate(learned.sensor))
    throw InputError("these scans yield no valid sensor: " + *fault);
  return learned;
}

}  // namespace lego_loam_sc
