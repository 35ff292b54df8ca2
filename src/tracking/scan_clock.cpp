// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/scan_clock.hpp"

#include <cmath>

#include "core/time.hpp"

namespace lego_loam_sc {
namespace {

constexpr std::int64_t kLateNs = 1'000'000'000;
// Up to here the motion before a gap says something about the motion in it.
constexpr std::int64_t kLongestGapNs = 5'000'000'000;
constexpr std::int64_t kFarthestStampNs = 4'600'000'000'000'000'000;

bool is_step(std::int64_t nanoseconds) {
  return nanoseconds > 0 && nanoseconds <= kLongestGapNs;
}

}  // namespace

ScanClock::ScanClock(double period_s) : step_ns_(std::llround(1e9 * period_s)) {}

std::optional<ScanTime> ScanClock::read(std::int64_t stamp_ns) {
  if (stamp_ns < -kFarthestStampNs || stamp_ns > kFarthestStampNs) return std::nullopt;
  if (!started_) {
    started_ = true;
    stamp_ns_ = time_ns_ = stamp_ns;
    return ScanTime{time_ns_, 0.0};
  }
  const std::int64_t since_last = stamp_ns - stamp_ns_;
  if (since_last <= 0 && since_last > -kLateNs) return std::nullopt;

  ScanTime result;
  if (is_step(since_last)) {
    step_ns_ = since_last;
  } else {
    result.jump_s = seconds(since_last);
    const bool jumped_back = ahead_before_ns_ && is_step(stamp_ns + *ahead_before_ns_ - time_ns_);
    const std::int64_t ahead = jumped_back ? *ahead_before_ns_ : time_ns_ + step_ns_ - stamp_ns;
    ahead_before_ns_ = ahead_ns_;
    ahead_ns_ = ahead;
  }
  stamp_ns_ = stamp_ns;
  time_ns_ = result.time_ns = stamp_ns + ahead_ns_;
  return result;
}

}  // namespace lego_loam_sc
