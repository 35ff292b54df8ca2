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

constexpr double kMinSweep = 0.02;   // s
constexpr double kMaxSweep = 0.5;    // s
constexpr double kSameClock = 1.0;   // s
constexpr double kMaxStamp = 4.6e9;  // s; differences fit into 64 bits of nanoseconds

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

PointTimes interpret_point_times(std::span<const double> times, NumberType type,
                                 const StampHint& hint, const std::string& file) {
  PointTimes result{hint.stamp_ns, {}, std::nullopt, "the points have no times"};
  const Limits limits = find_limits(times);
  if (!(limits.latest > limits.earliest)) return result;
  if (hint.unit == TimeUnit::none) {
    result.decision = "the point times are ignored as requested";
    return result;
  }
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

}  // namespace lego_loam_sc
