// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/sweep_unit.hpp"

#include <cmath>

#include "core/time.hpp"

namespace lego_loam_sc {
namespace {

// Stamps jitter and sweeps overlap a little: only this many gaps are too long.
constexpr double kTooLong = 1.5;
// A sweep that is too long by a power of ten, but for this factor, has a wrong unit: a turn may not
// fill the gap quite, and stamps jitter. It also is much longer than the period of the sensor.
constexpr double kNearPower = 1.3;
constexpr double kPeriods = 3.0;
constexpr double kSmallestPower = 1.0;
constexpr double kLargestPower = 3.0;
// The first scans decide at once, later ones in a row.
constexpr int kInARow = 3;

}  // namespace

void SweepUnit::add(std::int64_t stamp_ns, double span) {
  const std::optional<std::int64_t> last = stamp_ns_;
  stamp_ns_ = stamp_ns;
  if (!last || stamp_ns <= *last || span <= 0.0) return;
  const double gaps = span / seconds(stamp_ns - *last);
  ++compared_;
  double factor = 1.0;
  if (gaps > kTooLong) {
    ++too_long_;
    const double power = std::round(std::log10(gaps));
    const bool near = std::abs(std::log10(gaps) - power) < std::log10(kNearPower);
    if (near && power >= kSmallestPower && power <= kLargestPower && span > kPeriods * period_)
      factor = std::pow(10.0, -power);
  }
  contradictions_ = factor == factor_ ? 0 : contradictions_ + 1;
  if (compared_ > 1 && contradictions_ < kInARow) return;
  factor_ = factor;
  contradictions_ = 0;
}

}  // namespace lego_loam_sc
