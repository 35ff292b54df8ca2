// SPDX-License-Identifier: BSD-3-Clause
#include "slam/health.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lego_loam_sc {
namespace {

SensorModel sensor_of_ten_thousand_beams() {
  SensorModel sensor;
  sensor.elevation_deg = {-15, -5, 5, 15};
  sensor.columns = 2500;
  sensor.range_noise = 0.02;
  return sensor;
}

double value(const Vitals& vitals, Vital vital) {
  return vitals[static_cast<std::size_t>(vital)];
}

TEST(Health, ValuesAreSharesOfWhatTheSensorCanGive) {
  ScanReport report;
  report.points = 5000;
  report.edges_large = 100;
  report.planars_large = 900;
  report.map_points = 400;
  report.map_matches = 300;
  report.map_rmse = 0.05;
  report.degenerate_translations = 1;
  report.degenerate_rotations = 1;
  report.prediction_m = 0.25;
  const Vitals vitals = vitals_of(report, sensor_of_ten_thousand_beams(), 0.05);
  EXPECT_DOUBLE_EQ(value(vitals, Vital::points), 0.5);
  EXPECT_DOUBLE_EQ(value(vitals, Vital::features), 1000);
  EXPECT_DOUBLE_EQ(value(vitals, Vital::inliers), 0.75);
  EXPECT_DOUBLE_EQ(value(vitals, Vital::residual), 2.5);
  EXPECT_DOUBLE_EQ(value(vitals, Vital::degeneracy), 2);
  EXPECT_DOUBLE_EQ(value(vitals, Vital::prediction), 0.25);
  EXPECT_DOUBLE_EQ(value(vitals, Vital::delay), 0.05);
}

TEST(Health, WhatAScanHasNotIsNoFault) {
  ScanReport report;
  report.points = 5000;
  const Vitals vitals = vitals_of(report, sensor_of_ten_thousand_beams(), 0.0);
  for (const Vital vital : {Vital::inliers, Vital::residual, Vital::degeneracy}) {
    EXPECT_TRUE(std::isnan(value(vitals, vital)));
    EXPECT_EQ(level_of(value(vitals, vital), limits_of({})[static_cast<std::size_t>(vital)]),
              HealthLevel::ok);
  }
}

TEST(Health, LevelsBeginAtTheirLimits) {
  for (const VitalLimit& limit : limits_of({})) {
    const double worse = limit.low_is_bad ? -1e-9 : 1e-9;
    EXPECT_EQ(level_of(limit.warning - worse, limit), HealthLevel::ok) << limit.name;
    EXPECT_EQ(level_of(limit.warning + worse, limit), HealthLevel::warning) << limit.name;
    EXPECT_EQ(level_of(limit.error - worse, limit), HealthLevel::warning) << limit.name;
    EXPECT_EQ(level_of(limit.error + worse, limit), HealthLevel::error) << limit.name;
  }
}

}  // namespace
}  // namespace lego_loam_sc
