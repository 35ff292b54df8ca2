// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "core/sensor_model.hpp"
#include "slam/report.hpp"
#include "slam/settings.hpp"

namespace lego_loam_sc {

/// What an operator watches. HealthSettings says why the levels are where they are.
enum class Vital { points, features, inliers, residual, degeneracy, prediction, delay };
constexpr std::size_t kVitals = 7;

/// What a value of a vital is judged as.
enum class HealthLevel { ok, warning, error };
constexpr std::string_view to_string(HealthLevel level) {
  switch (level) {
    case HealthLevel::ok: return "ok";
    case HealthLevel::warning: return "warning";
    case HealthLevel::error: return "error";
  }
  return "unknown";
}

/// Where a vital begins to be bad.
struct VitalLimit {
  std::string_view name;  ///< as in scans.csv and summary.json
  std::string_view unit;  ///< of the levels; empty for counts
  double warning;         ///< from here on, downwards when `low_is_bad`
  double error;           ///< farther in the same direction
  bool low_is_bad;
};

/// The limit of each vital, in their order.
using VitalLimits = std::array<VitalLimit, kVitals>;
VitalLimits limits_of(const HealthSettings& settings);

/// The values of a scan in the units of the limits; NaN where the scan has none, as the first has
/// no residual.
using Vitals = std::array<double, kVitals>;

/// `delay_s`: how far the run would be behind a live sensor after this scan.
Vitals vitals_of(const ScanReport& report, const SensorModel& sensor, double delay_s);

/// NaN is ok.
HealthLevel level_of(double value, const VitalLimit& limit);

}  // namespace lego_loam_sc
