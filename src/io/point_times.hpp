// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/raw_scan.hpp"

namespace lego_loam_sc {

/// Unit of per-point times; `none` = ignore them.
enum class TimeUnit { seconds, milliseconds, microseconds, nanoseconds, none };

/// Prior knowledge about a scan's stamp and times.
struct StampHint {
  std::int64_t stamp_ns = 0;
  bool certain = false;          ///< false: assumed from the index of the scan
  std::optional<TimeUnit> unit;  ///< nothing: decide from the values
};

/// Result of interpret_point_times.
struct PointTimes {
  std::int64_t stamp_ns = 0;
  std::vector<std::int32_t> offset_ns;  ///< empty: the points have no times
  std::vector<std::uint32_t> stray;     ///< points whose times are far outside the sweep
  std::optional<TimeUnit> unit;         ///< used; nothing when the points have no times
  std::string decision;                 ///< the interpretation, one sentence
};

/// Interprets per-point times; the only place that does. A sweep lasts between 20 and 500 ms: the
/// unit is the one in which the span of the times does. Times within one second of zero are
/// relative to the stamp, others are absolute. Absolute times are on the clock of the stamp when
/// they lie within one second of it; otherwise the earliest time is assumed to be at the stamp, and
/// replaces the stamp when that is uncertain. The offset of NaN is 0. Constant times count as no
/// times. Unsigned times that wrap below zero are read as the negative ones that they stand for. Up
/// to 5 % of the times may be stray: they decide nothing, and their points are to be left out. When
/// no unit fits, throws InputError, which names `file`, the values and the setting to give.
PointTimes interpret_point_times(std::span<const double> times, NumberType type,
                                 const StampHint& hint, const std::string& file);

/// Whether offsets tell points of a sweep apart: there are some, and they are not all the same.
bool are_times(std::span<const std::int32_t> offset_ns);

}  // namespace lego_loam_sc
