// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_times.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/time.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kMinSweep = 0.02;      // s
constexpr double kMaxSweep = 0.5;       // s
constexpr double kSameClock = 1.0;      // s
constexpr double kMaxStamp = 4.6e9;     // s; differences fit into 64 bits of nanoseconds
constexpr std::size_t kSamples = 1000;  // times that the bulk of a scan is measured with, about
constexpr double kStrayShare = 0.05;    // maximum, at either end and in all

constexpr std::array<double, 4> kSeconds = {1.0, 1e-3, 1e-6, 1e-9};
constexpr std::array<const char*, 4> kUnitNames = {"seconds", "milliseconds", "microseconds",
                                                   "nanoseconds"};

struct Limits {
  double earliest = std::numeric_limits<double>::infinity();
  double latest = -std::numeric_limits<double>::infinity();
};

Limits find_limits(std::span<const double> times) {
  Limits limits;
  for (const double time : times) {
    if (!std::isfinite(time)) continue;
    limits.earliest = std::min(limits.earliest, time);
    limits.latest = std::max(limits.latest, time);
  }
  return limits;
}

// An unsigned field cannot hold a time before zero: a driver that subtracts beyond it leaves the
// upper half of the type's numbers to them. No sweep spans half of 32 bits in any unit.
double numbers_of_unsigned(NumberType type) {
  if (type == NumberType::uint32) return 0x1p32;
  return type == NumberType::uint64 ? 0x1p64 : 0.0;
}

std::vector<double> without_wraps(std::span<const double> times, double numbers) {
  std::vector<double> result(times.begin(), times.end());
  for (double& time : result)
    if (time >= 0.5 * numbers) time -= numbers;
  return result;
}

// The limits within which times may belong to the sweep: the span of most of them, once more at
// either end.
Limits plausible_limits(std::span<const double> times) {
  std::vector<double> samples;
  for (std::size_t i = 0; i < times.size(); i += 1 + times.size() / kSamples)
    if (std::isfinite(times[i])) samples.push_back(times[i]);
  if (samples.empty()) return {};
  std::ranges::sort(samples);
  const auto skipped = static_cast<std::size_t>(kStrayShare * static_cast<double>(samples.size()));
  const double first = samples[skipped];
  const double last = samples[samples.size() - 1 - skipped];
  return {first - (last - first), last + (last - first)};
}

std::vector<std::uint32_t> find_strays(std::span<const double> times) {
  std::vector<std::uint32_t> stray;
  const Limits plausible = plausible_limits(times);
  if (!(plausible.latest > plausible.earliest)) return stray;
  std::size_t finite = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    finite += std::isfinite(times[i]);
    if (times[i] < plausible.earliest || times[i] > plausible.latest)
      stray.push_back(static_cast<std::uint32_t>(i));
  }
  // More than some are no strays: the sweep is an odd one.
  if (static_cast<double>(stray.size()) > kStrayShare * static_cast<double>(finite)) stray.clear();
  return stray;
}

bool is_sweep(double seconds) {
  return seconds >= kMinSweep && seconds <= kMaxSweep;
}

// Absolute seconds in float32 have a resolution of 128 s, which could look like milliseconds.
bool is_too_coarse(const Limits& limits, NumberType type) {
  const double largest = std::max(std::abs(limits.earliest), std::abs(limits.latest));
  return type == NumberType::float32 &&
         largest * std::numeric_limits<float>::epsilon() > 0.01 * (limits.latest - limits.earliest);
}

[[noreturn]] void fail(const Limits& limits, NumberType type, const std::string& file) {
  throw InputError(file + ": the point times run from " + to_text(limits.earliest) + " to " +
                   to_text(limits.latest) + ", which is not a sweep of 20 to 500 ms in any unit" +
                   (is_too_coarse(limits, type) ? " (float32 is too coarse for them)" : "") +
                   "; set point_times to s, ms, us, ns or none in dataset.yaml beside the scans");
}

std::size_t decide_unit(const Limits& limits, NumberType type, const StampHint& hint,
                        const std::string& file) {
  const double span = limits.latest - limits.earliest;
  if (hint.unit) {
    const auto unit = static_cast<std::size_t>(*hint.unit);
    // Any unit may be forced, as long as the offsets do not overflow.
    if (span * kSeconds[unit] > kSameClock) fail(limits, type, file);
    return unit;
  }
  for (std::size_t unit = 0; unit < kSeconds.size(); ++unit)
    if (is_sweep(span * kSeconds[unit]) && !is_too_coarse(limits, type)) return unit;
  fail(limits, type, file);
}

// The origin of the times.
struct Origin {
  double time;            // of the scan's stamp, in the unit of the times
  std::int64_t stamp_ns;  // of the scan
  const char* description;
};

Origin decide_origin(const Limits& limits, double scale, const StampHint& hint) {
  const double earliest = limits.earliest * scale;
  const double latest = limits.latest * scale;
  const double stamp = seconds(hint.stamp_ns);
  if (std::max(std::abs(earliest), std::abs(latest)) <= kSameClock)
    return {0.0, hint.stamp_ns, "relative to the stamp of the scan"};
  if (hint.certain && std::abs(earliest - stamp) <= kSameClock)
    return {stamp / scale, hint.stamp_ns, "on the clock of the stamp"};
  if (!hint.certain && std::abs(earliest) < kMaxStamp)
    return {limits.earliest, nanoseconds(earliest), "on a clock that also gives the stamp"};
  return {limits.earliest, hint.stamp_ns,
          "on another clock than the stamp, the earliest is assumed to be at the stamp"};
}

}  // namespace

PointTimes interpret_point_times(std::span<const double> given_times, NumberType type,
                                 const StampHint& hint, const std::string& file) {
  PointTimes result{hint.stamp_ns, {}, {}, std::nullopt, "the points have no times"};
  Limits limits = find_limits(given_times);
  if (!(limits.latest > limits.earliest)) {
    if (std::isfinite(limits.latest))
      result.decision += ": their field of times is " + to_text(limits.latest) + " for all of them";
    return result;
  }
  if (hint.unit == TimeUnit::none) {
    result.decision = "the point times are ignored as requested";
    return result;
  }
  std::vector<double> changed;
  std::span<const double> times = given_times;
  const double numbers = numbers_of_unsigned(type);
  if (numbers > 0.0 && limits.latest - limits.earliest > 0.5 * numbers) {
    changed = without_wraps(times, numbers);
    times = changed;
  }
  result.stray = find_strays(times);
  if (!result.stray.empty()) {
    if (changed.empty()) changed.assign(times.begin(), times.end());
    for (const std::uint32_t i : result.stray)
      changed[i] = std::numeric_limits<double>::quiet_NaN();
    times = changed;
  }
  limits = find_limits(times);
  const std::size_t unit = decide_unit(limits, type, hint, file);
  result.unit = static_cast<TimeUnit>(unit);
  const double scale = kSeconds[unit];

  const Origin origin = decide_origin(limits, scale, hint);
  result.stamp_ns = origin.stamp_ns;
  result.offset_ns.resize(times.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::isfinite(times[i]))  // subtract before scaling to keep the accuracy of the file
      result.offset_ns[i] =
          static_cast<std::int32_t>(nanoseconds((times[i] - origin.time) * scale));
  const auto milliseconds = [&](double time) {
    return to_fixed((time - origin.time) * scale * 1e3, 1);
  };
  result.decision = "the point times are " + std::string(kUnitNames[unit]) + " " +
                    origin.description + "; a sweep runs from " + milliseconds(limits.earliest) +
                    " to " + milliseconds(limits.latest) + " ms after it";
  return result;
}

bool are_times(std::span<const std::int32_t> offset_ns) {
  return std::ranges::adjacent_find(offset_ns, std::ranges::not_equal_to{}) != offset_ns.end();
}

}  // namespace lego_loam_sc
