// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/elevation_bias.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lego_loam_sc {
namespace {

constexpr double kSigma = 0.03;  // m

// Flat ground round the sensor, met by a map that was seen from other ranges, when all elevation
// angles are off by `error` rad.
std::vector<Correspondence> ground(double error, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, kSigma);
  std::uniform_real_distribution<double> range(4.0, 40.0), azimuth(-3.14, 3.14);
  std::vector<Correspondence> all(400);
  for (Correspondence& c : all) {
    const double r = range(random), a = azimuth(random);
    c.point = {r * std::cos(a), r * std::sin(a), -1.7};
    c.anchor = {c.point.x(), c.point.y(), -1.7};
    c.direction = Eigen::Vector3d::UnitZ();
    c.weight = 1.0 / (kSigma * kSigma);
    c.range_difference = r - range(random);
    c.point.z() += noise(random) - error * c.range_difference;
  }
  return all;
}

// What is found of an error of `true_deg` in `scans` scans, each corrected by what was found
// before.
double found_deg(double true_deg, int scans) {
  std::mt19937 random(5);
  ElevationBias bias;
  for (int k = 0; k < scans; ++k) {
    const auto matched = ground(radians(true_deg) - bias.value(), random);
    bias.add(matched, Pose::Identity(), 3.0,
             sweep_normal_equations(matched, Pose::Identity(), Vector6::Zero(), 3.0));
  }
  return degrees(bias.value());
}

TEST(ElevationBias, ApproachesTheErrorOfTheBeamsFromBothSides) {
  for (const double error : {-0.3, 0.0, 0.2}) {
    EXPECT_NEAR(found_deg(error, 200), error, 0.02);
    EXPECT_LT(std::abs(found_deg(error, 200) - error),
              std::abs(found_deg(error, 10) - error) + 0.005);
  }
}

TEST(ElevationBias, GoesOneStepAtATime) {
  EXPECT_GT(found_deg(0.3, 1), 0.0);
  EXPECT_LT(found_deg(0.3, 1), 0.2);
}

TEST(ElevationBias, NothingFollowsFromNothing) {
  ElevationBias bias;
  bias.add({}, Pose::Identity(), 0.1, NormalEquations<12>{});
  EXPECT_EQ(bias.value(), 0.0);
}

}  // namespace
}  // namespace lego_loam_sc
