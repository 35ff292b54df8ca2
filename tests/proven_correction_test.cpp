// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/proven_correction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lego_loam_sc {
namespace {

// In degrees: what a drive on roads gives.
constexpr double kFloor = 0.1;
constexpr double kScatter = 0.25;

void measure(ProvenCorrection& correction, double error, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> scatter(error, kScatter);
  for (int i = 0; i < count; ++i) correction.add(scatter(random));
}

TEST(ProvenCorrection, FindsAnErrorWithinItsUncertainty) {
  for (const double error : {0.3, -0.3})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      ProvenCorrection correction(kFloor);
      measure(correction, error, 600, seed);
      EXPECT_NEAR(correction.value(), error, 4.0 * correction.sigma()) << seed;
      EXPECT_LT(correction.sigma(), 0.02) << seed;
    }
}

TEST(ProvenCorrection, IsNeverAppliedWithoutAnError) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    ProvenCorrection correction(kFloor);
    std::mt19937 random(seed);
    std::normal_distribution<double> scatter(0.0, kScatter);
    for (int i = 0; i < 600; ++i) {
      correction.add(scatter(random));
      ASSERT_EQ(correction.value(), 0.0) << seed << " " << i;
    }
  }
}

TEST(ProvenCorrection, LeavesAnErrorBelowItsFloorAlone) {
  ProvenCorrection correction(kFloor);
  measure(correction, 0.06, 2000, 1);
  EXPECT_EQ(correction.value(), 0.0);
}

TEST(ProvenCorrection, IsTakenBackWhenLaterScansContradict) {
  ProvenCorrection correction(kFloor);
  measure(correction, 0.3, 300, 1);
  ASSERT_NE(correction.value(), 0.0);
  measure(correction, -0.1, 600, 2);
  EXPECT_EQ(correction.value(), 0.0);
}

TEST(ProvenCorrection, AFewMeasurementsProveNothing) {
  ProvenCorrection correction(kFloor);
  measure(correction, 0.5, 80, 1);
  EXPECT_EQ(correction.value(), 0.0);
}

}  // namespace
}  // namespace lego_loam_sc
