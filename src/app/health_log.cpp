// SPDX-License-Identifier: BSD-3-Clause
#include "app/health_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/time.hpp"

namespace lego_loam_sc {
namespace {

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

// How late a live run would be with this scan's result: scans that take longer than the sensor
// needs for the next one add up.
double HealthLog::follow_delay(const ScanReport& report) {
  if (report.status == Status::out_of_order) return delay_s_;
  const double busy_s =
      1e-3 * std::accumulate(report.milliseconds.begin(), report.milliseconds.end(), 0.0);
  const bool is_step = stamp_ns_ && report.stamp_jump_s == 0.0;
  const double since_last_s = is_step ? seconds(report.stamp_ns - *stamp_ns_) : sensor_.period;
  stamp_ns_ = report.stamp_ns;
  delay_s_ = std::max(0.0, delay_s_ - since_last_s) + busy_s;
  return delay_s_;
}

HealthLog::Line HealthLog::add(const ScanReport& report) {
  const Vitals values = vitals_of(report, sensor_, follow_delay(report));
  Line line{
      {}, {}, 1e3 * delay_s_, level_of(delay_s_, limits_[static_cast<std::size_t>(Vital::delay)])};
  for (std::size_t v = 0; v < kVitals; ++v) {
    const VitalLimit& limit = limits_[v];
    Sum& sum = sums_[v];
    if (std::isnan(values[v])) continue;
    if (!sum.worst || (limit.low_is_bad ? values[v] < *sum.worst : values[v] > *sum.worst)) {
      sum.worst = values[v];
      sum.worst_scan = report.index;
    }
    const HealthLevel level = level_of(values[v], limit);
    if (level == HealthLevel::ok) continue;
    ++(level == HealthLevel::warning ? sum.warnings : sum.errors);
    if (static_cast<Vital>(v) == Vital::delay) continue;
    std::string& names = level == HealthLevel::warning ? line.warnings : line.errors;
    names += (names.empty() ? "" : " ") + std::string(limit.name);
  }
  return line;
}

nlohmann::ordered_json HealthLog::to_json(Vital vital) const {
  const auto v = static_cast<std::size_t>(vital);
  const VitalLimit& limit = limits_[v];
  const Sum& sum = sums_[v];
  nlohmann::ordered_json json = {{"unit", limit.unit},         {"warning_level", limit.warning},
                                 {"error_level", limit.error}, {"warnings", sum.warnings},
                                 {"errors", sum.errors},       {"worst", nullptr},
                                 {"worst_scan", nullptr}};
  if (sum.worst) {
    json["worst"] = *sum.worst;
    json["worst_scan"] = sum.worst_scan;
  }
  return json;
}

nlohmann::ordered_json HealthLog::to_json() const {
  nlohmann::ordered_json json;
  for (std::size_t v = 0; v < kVitals; ++v)
    if (static_cast<Vital>(v) != Vital::delay)
      json[std::string(limits_[v].name)] = to_json(static_cast<Vital>(v));
  return json;
}

std::string HealthLog::text() const {
  std::string text;
  for (std::size_t v = 0; v < kVitals; ++v) {
    const VitalLimit& limit = limits_[v];
    const Sum& sum = sums_[v];
    if (!sum.worst || sum.warnings + sum.errors == 0) continue;
    const std::string unit = limit.unit.empty() ? "" : " " + std::string(limit.unit);
    text += std::string(limit.name) + ": " + std::to_string(sum.warnings) + " warnings, " +
            std::to_string(sum.errors) + " errors (levels " + short_text(limit.warning) + " and " +
            short_text(limit.error) + unit + "), worst " + short_text(*sum.worst) + unit +
            " in scan " + std::to_string(sum.worst_scan) + "\n";
  }
  return text;
}

}  // namespace lego_loam_sc
