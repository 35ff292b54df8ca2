// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace lego_loam_sc {

/// Compares how long sweeps last by the times of their points with the time from one scan to the
/// next: a sweep cannot be longer. One that is longer by a power of ten has its times in a wrong
/// unit, which can be put right.
class SweepUnit {
 public:
  /// `period`: s, of the sensor by its model. `factor`: assumed until scans tell.
  explicit SweepUnit(double period, double factor = 1.0) : period_(period), factor_(factor) {}

  /// Takes the stamp of the next scan and the span of its times, s.
  void add(std::int64_t stamp_ns, double span);

  /// Begins with the first scan again, but keeps the factor.
  void restart() { *this = SweepUnit(period_, factor_); }

  /// What the times are to be multiplied by: 1, 0.1, 0.01, 0.001.
  double factor() const { return factor_; }
  /// Scans whose sweeps were longer than the gap to the scan before, and all that were compared.
  /// @{
  int too_long() const { return too_long_; }
  int compared() const { return compared_; }
  /// @}

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(factor_, stamp_ns_, contradictions_, too_long_, compared_);
  }

 private:
  double period_;
  double factor_;
  std::optional<std::int64_t> stamp_ns_;  // of the last scan
  int contradictions_ = 0;                // scans in a row that ask for another factor
  int too_long_ = 0;
  int compared_ = 0;
};

}  // namespace lego_loam_sc
