// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace lego_loam_sc {

/// When a scan was taken.
struct ScanTime {
  std::int64_t time_ns = 0;  ///< on a clock that goes forward without jumps
  double jump_s = 0.0;       ///< from the stamp before to this one when it is a jump, else 0
};

/// Makes a clock that goes forward out of stamps that may not. A stamp that is no later than the
/// one before, by less than a second, belongs to a scan that repeats or comes late. A step farther
/// back, or more than five seconds ahead, is a jump: the computer's clock was set, or the recording
/// paused. How far the vehicle came meanwhile is unknown either way, so the clock goes on by one
/// ordinary step. The next scan may jump back to where the stamps were, when one of them alone was
/// wrong.
class ScanClock {
 public:
  /// `period_s`: the ordinary step until two stamps have shown it.
  explicit ScanClock(double period_s);

  /// The time of the next scan; nothing for one that repeats, comes late or whose stamp is so far
  /// from zero (146 years) that differences would overflow. Such a scan leaves the clock as it is.
  std::optional<ScanTime> read(std::int64_t stamp_ns);

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(step_ns_, started_, stamp_ns_, time_ns_, ahead_ns_, ahead_before_ns_);
  }

 private:
  std::int64_t step_ns_;
  bool started_ = false;
  std::int64_t stamp_ns_ = 0;                    // the last one
  std::int64_t time_ns_ = 0;                     // its time
  std::int64_t ahead_ns_ = 0;                    // time less stamp
  std::optional<std::int64_t> ahead_before_ns_;  // the same before the last jump
};

}  // namespace lego_loam_sc
