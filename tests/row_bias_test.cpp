// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/row_bias.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lego_loam_sc {
namespace {

constexpr double kSigma = 0.02;  // m
constexpr int kRows = 8;

// Flat ground round the sensor in a map without error, seen by rows that are off by `error`, rad.
std::vector<Correspondence> ground(const std::vector<double>& error, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, kSigma);
  std::uniform_real_distribution<double> azimuth(-3.14, 3.14);
  std::vector<Correspondence> all;
  for (int i = 0; i < 400; ++i) {
    Correspondence c;
    c.row = static_cast<std::uint16_t>(i % kRows);
    const double r = 5.0 + 3.0 * c.row, a = azimuth(random);
    c.point = {r * std::cos(a), r * std::sin(a), -1.7};
    c.anchor = c.point;
    c.direction = Eigen::Vector3d::UnitZ();
    c.weight = 1.0 / (kSigma * kSigma);
    c.point.z() += noise(random) + error[c.row] * r;
    all.push_back(c);
  }
  return all;
}

// deg, what is left of errors when each scan is corrected by what was found before.
std::vector<double> left_deg(const std::vector<double>& true_deg, int scans) {
  std::mt19937 random(6);
  RowBias bias;
  std::vector<double> left(kRows);
  for (int k = 0; k <= scans; ++k) {
    std::vector<double> error(kRows);
    for (int row = 0; row < kRows; ++row) {
      error[row] = radians(true_deg[row]) + (k > 0 ? bias.values()[row] : 0.0);
      left[row] = degrees(error[row]);
    }
    bias.add(ground(error, random), Pose::Identity(), 3.0);
  }
  return left;
}

TEST(RowBias, FindsWhichRowsAreOff) {
  const std::vector<double> off = {0.06, -0.04, 0.0, 0.05, -0.06, 0.02, -0.01, 0.0};
  const std::vector<double> left = left_deg(off, 300);
  // What all have in common is not for it to find.
  for (int row = 0; row < kRows; ++row) EXPECT_NEAR(left[row], left[0], 0.01) << row;
}

TEST(RowBias, LeavesTheCommonErrorAlone) {
  for (const double left : left_deg(std::vector<double>(kRows, 0.1), 300))
    EXPECT_NEAR(left, 0.1, 0.005);
}

TEST(RowBias, NothingFollowsFromNothing) {
  RowBias bias;
  bias.add({}, Pose::Identity(), 3.0);
  EXPECT_TRUE(bias.values().empty());
}

}  // namespace
}  // namespace lego_loam_sc
