// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_times.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/time.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kShortestSweep = 0.02;  // s
constexpr double kLongestSweep = 0.5;    // s
constexpr double kSameClock = 1.0;       // s
constexpr double kLatestStamp = 4.6e9;  // s; the difference of two fits into 64 bits of nanoseconds

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

bool is_sweep(double seconds) {
  return seconds >= kShortestSweep && seconds <= kLongestSweep;
}

// Seconds of a clock in float32 are 128 s apart, which would pass for milliseconds.
bool is_too_coarse(const Limits& limits, NumberType type) {
  const double largest = std::max(std::abs(limits.earliest), std::abs(limits.latest));
  return type == NumberType::float32 &&
         largest * std::numeric_limits<float>::epsilon() > 0.01 * (limits.latest - limits.earliest);
}

[[noreturn]] void fail(const Limits& limits, NumberType type, const std::string& file) {
  throw InputError(file + ": the times of the points run from " + to_text(limits.earliest) +
                   " to " + to_text(limits.latest) +
                   ", which is no sweep of 20 to 500 ms in any unit" +
                   (is_too_coarse(limits, type) ? " (float32 is too coarse for them)" : "") +
                   "; set point_times to s, ms, us, ns or none in dataset.yaml beside the scans");
}

std::size_t decide_unit(const Limits& limits, NumberType type, const StampHint& hint,
                        const std::string& file) {
  const double span = limits.latest - limits.earliest;
  if (hint.unit) {
    const auto unit = static_cast<std::size_t>(*hint.unit);
    // A forced unit may be odd, but offsets must stay within what they can hold.
    if (span * kSeconds[unit] > kSameClock) fail(limits, type, file);
    return unit;
  }
  for (std::size_t unit = 0; unit < kSeconds.size(); ++unit)
    if (is_sweep(span * kSeconds[unit]) && !is_too_coarse(limits, type)) return unit;
  fail(limits, type, file);
}

// What the times count from.
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
    return {0.0, hint.stamp_ns, "from the stamp of the scan"};
  if (hint.certain && std::abs(earliest - stamp) <= kSameClock)
    return {stamp / scale, hint.stamp_ns, "on the clock of the stamp"};
  if (!hint.certain && std::abs(earliest) < kLatestStamp)
    return {limits.earliest, nanoseconds(earliest), "on a clock that gives the stamp too"};
  return {limits.earliest, hint.stamp_ns,
          "on another clock than the stamp, the first is taken for it"};
}

}  // namespace

PointTimes interpret_point_times(std::span<const double> times, NumberType type,
                                 const StampHint& hint, const std::string& file) {
  PointTimes result{hint.stamp_ns, {}, std::nullopt, "the points have no times"};
  const Limits limits = find_limits(times);
  if (!(limits.latest > limits.earliest)) return result;
  if (hint.unit == TimeUnit::none) {
    result.decision = "the times of the points are ignored, as asked for";
    return result;
  }
  const std::size_t unit = decide_unit(limits, type, hint, file);
  result.unit = static_cast<TimeUnit>(unit);
  const double scale = kSeconds[unit];

  const Origin origin = decide_origin(limits, scale, hint);
  result.stamp_ns = origin.stamp_ns;
  result.offset_ns.resize(times.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::isfinite(times[i]))  // the difference before the scale: it keeps the file's accuracy
      result.offset_ns[i] =
          static_cast<std::int32_t>(nanoseconds((times[i] - origin.time) * scale));
  const auto milliseconds = [&](double time) {
    return to_fixed((time - origin.time) * scale * 1e3, 1);
  };
  result.decision = "the times of the points are " + std::string(kUnitNames[unit]) + " " +
                    origin.description + "; a sweep runs from " + milliseconds(limits.earliest) +
                    " to " + milliseconds(limits.latest) + " ms after it";
  return result;
}

}  // namespace lego_loam_sc
