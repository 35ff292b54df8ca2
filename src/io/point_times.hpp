// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/raw_scan.hpp"

namespace lego_loam_sc {

/// What per-point times count in; `none` = they are to be ignored.
enum class TimeUnit { seconds, milliseconds, microseconds, nanoseconds, none };

/// What is known about a scan's time before its points are looked at.
struct StampHint {
  std::int64_t stamp_ns = 0;
  bool certain = false;          ///< false: made up from the number of the scan
  std::optional<TimeUnit> unit;  ///< nothing = decide from the numbers
};

/// What interpret_point_times makes of the times.
struct PointTimes {
  std::int64_t stamp_ns = 0;
  std::vector<std::int32_t> offset_ns;  ///< empty: the points have no times
  std::vector<std::uint32_t> stray;     ///< points whose times are far outside of the sweep
  std::optional<TimeUnit> unit;         ///< that was used; nothing when the points have no times
  std::string decision;                 ///< what was decided and from what, one sentence
};

/// The only place that gives per-point times a meaning. A sweep lasts between 20 and 500 ms: the
/// unit in which the span of the times does decides. Times within one second of zero count from the
/// stamp; others are a clock's. That clock is the stamp's own when they lie within one second of
/// it, else the earliest time is taken to be at the stamp, and becomes the stamp when that is
/// uncertain. NaN is no time, its offset is 0. Times that are all the same are no times. Unsigned
/// times that run through zero are taken for the negative ones that they stand for. Up to 5 % of
/// the times may be stray: they decide nothing, and their points have to be left out. Throws
/// InputError, which begins with `file`, with the numbers seen and the setting to give when no unit
/// fits.
PointTimes interpret_point_times(std::span<const double> times, NumberType type,
                                 const StampHint& hint, const std::string& file);

/// Whether offsets tell points of a sweep apart: there are some, and they are not all the same.
bool are_times(std::span<const std::int32_t> offset_ns);

}  // namespace lego_loam_sc
