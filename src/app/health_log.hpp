// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "slam/health.hpp"

namespace lego_loam_sc {

/// The health of the scans of a run, each and in sum.
class HealthLog {
 public:
  explicit HealthLog(const SensorModel& sensor) : sensor_(sensor) {}

  /// What scans.csv says about a scan: names of the vitals at their warning and error levels,
  /// separated by blanks. Those of the delay, which differs from run to run, stand apart.
  struct Line {
    std::string warnings, errors;
    double delay_ms;
    HealthLevel delay_level;
  };
  Line add(const ScanReport& report);

  /// Levels, counts and the worst value of a vital; null for one that no scan had.
  nlohmann::ordered_json to_json(Vital vital) const;
  /// The same of all but the delay.
  nlohmann::ordered_json to_json() const;

  /// A line for the terminal for each vital that was not always ok.
  std::string text() const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(sums_, stamp_ns_, delay_s_);
  }

 private:
  struct Sum {
    std::size_t warnings = 0;
    std::size_t errors = 0;
    std::optional<double> worst;
    int worst_scan = 0;

    template <class Archive>
    void state(Archive& archive) {
      archive(warnings, errors, worst, worst_scan);
    }
  };

  double follow_delay(const ScanReport& report);

  SensorModel sensor_;
  std::array<Sum, kVitals> sums_;
  std::optional<std::int64_t> stamp_ns_;
  double delay_s_ = 0.0;
};

}  // namespace lego_loam_sc
