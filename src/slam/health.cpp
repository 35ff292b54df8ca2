// SPDX-License-Identifier: BSD-3-Clause
#include "slam/health.hpp"

#include <cmath>
#include <limits>

namespace lego_loam_sc {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<VitalLimits, kVitals> kLimits = {{
    // Share of the sensor's beams that brought a point. Under an open sky it is near one half, and
    // two thirds of the sky side of a covered lens leave a tenth.
    {"points", "share", 0.10, 0.02, true},
    // A pose has six unknowns: a hundred features for each average the noise to a tenth, with
    // twenty single wrong ones show.
    {"features", "", 600, 120, true},
    // Share of the matched points that lie on a known surface. Default of mapping.min_matched_share
    // is the error level: there a match is refused.
    {"inliers", "share", 0.4, 0.3, true},
    // In sigmas of the sensor's range. Surfaces are no planes and sweeps no snapshots, which costs
    // two; at ten the points lie beside the surfaces.
    {"residual", "sigma", 5, 10, false},
    // Directions of translation and rotation that the scan does not hold: one, as along a tunnel,
    // is carried over by the prediction, with more the pose floats.
    {"degeneracy", "directions", 1, 2, false},
    // Metres between the predicted and the found position. Within a turn of 0.1 s three times
    // gravity makes 0.3 m; at 1 m the search may end in the wrong place.
    {"prediction", "m", 0.3, 1, false},
    // Seconds behind a live sensor: one turn waits, or ten do and a driver begins to drop them.
    {"delay", "s", 0.1, 1, false},
}};

double share(double part, double whole) {
  return whole > 0.0 ? part / whole : kNone;
}

}  // namespace

const std::array<VitalLimits, kVitals>& vital_limits() {
  return kLimits;
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

HealthLevel level_of(Vital vital, double value) {
  const VitalLimits& limits = kLimits[static_cast<std::size_t>(vital)];
  const auto reached = [&](double level) {
    return limits.low_is_bad ? value < level : value >= level;
  };
  if (reached(limits.error)) return HealthLevel::error;
  return reached(limits.warning) ? HealthLevel::warning : HealthLevel::ok;
}

}  // namespace lego_loam_sc
