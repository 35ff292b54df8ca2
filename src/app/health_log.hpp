// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>

#include "slam/health.hpp"

namespace lego_loam_sc {

/// The health of each scan and of the whole run. The delay is kept apart: it depends on the machine
/// and differs from run to run, while the other columns are compared byte by byte.
class HealthLog {
 public:
  HealthLog(SensorModel sensor, const HealthSettings& settings)
      : sensor_(std::move(sensor)), limits_(limits_of(settings)) {}

  /// The health columns of scans.csv.
  struct Line {
    std::string warnings;     ///< names of the vitals at this level, separated by blanks
    std::string errors;       ///< the same
    double delay_ms;          ///< by which a live run would be behind the sensor
    HealthLevel delay_level;  ///< of `delay_ms`
  };
  /// Evaluates the next scan.
  Line add(const ScanReport& report);

  /// One vital over all scans: its levels, the number of scans at each, and its worst value with
  /// the scan that had it; null when no scan had a value.
  nlohmann::ordered_json to_json(Vital vital) const;
  /// The same for each vital except the delay, by name.
  nlohmann::ordered_json to_json() const;

  /// A line for the terminal for each vital that was not always ok.
  std::string text() const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(sums_, stamp_ns_, delay_s_);
  }

 private:
  // Of a vital over all scans so far.
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
  VitalLimits limits_;
  std::array<Sum, kVitals> sums_;
  std::optional<std::int64_t> stamp_ns_;  // of the last scan
  double delay_s_ = 0.0;                  // after it
};

}  // namespace lego_loam_sc
