// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sweep_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lego_loam_sc {
namespace {

constexpr double kSigma = 0.02;  // m
const Vector6 kTwist = (Vector6() << 5.0, 0.0, 0.0, 0.0, 0.0, 0.3).finished();

// Planes in all directions, seen in a sweep that was de-skewed although its times would have to be
// multiplied by `factor` first.
std::vector<Correspondence> seen(double factor, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, kSigma);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Correspondence> all;
  for (int i = 0; i < 500; ++i) {
    Correspondence c;
    c.anchor = 20.0 * Eigen::Vector3d(uniform(random), uniform(random), 0.2 * uniform(random));
    c.direction = Eigen::Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
    c.time = 0.05 * uniform(random);
    c.weight = 1.0 / (kSigma * kSigma);
    const Eigen::Vector3d velocity = kTwist.head<3>() + kTwist.tail<3>().cross(c.anchor);
    c.point = c.anchor + noise(random) * c.direction + (1.0 - factor) * c.time * velocity;
    all.push_back(c);
  }
  return all;
}

SweepCheck after(int scans, double factor) {
  std::mt19937 random(3);
  SweepCheck check;
  for (int k = 0; k < scans; ++k)
    check.add(seen(factor, random), Pose::Identity(), 20.0, kTwist, kTwist);
  return check;
}

TEST(SweepCheck, TellsByHowMuchTheTimesAreWrong) {
  EXPECT_NEAR(after(100, 1.0).factor(), 1.0, 0.05);
  EXPECT_NEAR(after(100, 0.0).factor(), 0.0, 0.1);
  EXPECT_NEAR(after(100, -1.0).factor(), -1.0, 0.2);
}

TEST(SweepCheck, IsSureAfterSomeScans) {
  EXPECT_TRUE(after(4, 0.0).fits());
  EXPECT_TRUE(after(100, 1.0).fits());
  EXPECT_FALSE(after(100, 0.0).fits());
  EXPECT_FALSE(after(100, -1.0).fits());
}

TEST(SweepCheck, AStandingSensorSaysNothing) {
  std::mt19937 random(3);
  SweepCheck check;
  for (int k = 0; k < 100; ++k)
    check.add(seen(0.0, random), Pose::Identity(), 20.0, Vector6::Zero(), Vector6::Zero());
  EXPECT_EQ(check.scans(), 0);
  EXPECT_TRUE(check.fits());
}

}  // namespace
}  // namespace lego_loam_sc
