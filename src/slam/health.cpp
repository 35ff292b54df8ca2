// SPDX-License-Identifier: BSD-3-Clause
#include "slam/health.hpp"

#include <cmath>
#include <limits>

namespace lego_loam_sc {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double share(double part, double whole) {
  return whole > 0.0 ? part / whole : kNone;
}

}  // namespace

VitalLimits limits_of(const HealthSettings& s) {
  return {{{"points", "share", s.points_warning, s.points_error, true},
           {"features", "", s.features_warning, s.features_error, true},
           {"inliers", "share", s.inliers_warning, s.inliers_error, true},
           {"residual", "sigma", s.residual_warning, s.residual_error, false},
           {"degeneracy", "directions", s.degeneracy_warning, s.degeneracy_error, false},
           {"prediction", "m", s.prediction_warning, s.prediction_error, false},
           {"delay", "s", s.delay_warning, s.delay_error, false}}};
}

Vitals vitals_of(const ScanReport& r, const SensorModel& sensor, double delay_s) {
  Vitals values;
  values.fill(kNone);
  const auto set = [&](Vital vital, double value) {
    values[static_cast<std::size_t>(vital)] = value;
  };
  set(Vital::delay, delay_s);
  if (r.status == Status::out_of_order || r.status == Status::repeated) return values;
  set(Vital::points, share(static_cast<double>(r.points), 1.0 * sensor.rows() * sensor.columns));
  set(Vital::features, static_cast<double>(r.edges_large + r.planars_large));
  set(Vital::inliers, share(r.map_matches, r.map_points));
  if (r.map_rmse > 0.0) set(Vital::residual, share(r.map_rmse, sensor.range_noise));
  if (r.map_matches > 0) set(Vital::degeneracy, r.degenerate_translations + r.degenerate_rotations);
  set(Vital::prediction, r.prediction_m);
  return values;
}

HealthLevel level_of(double value, const VitalLimit& limit) {
  const auto reached = [&](double level) {
    return limit.low_is_bad ? value < level : value >= level;
  };
  if (reached(limit.error)) return HealthLevel::error;
  return reached(limit.warning) ? HealthLevel::warning : HealthLevel::ok;
}

}  // namespace lego_loam_sc
