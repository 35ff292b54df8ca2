// SPDX-License-Identifier: BSD-3-Clause
#include "features/roughness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "features/feature_row.hpp"

namespace lego_loam_sc {
namespace {

// Equation (1), one neighbour after the other.
double naive_roughness(const std::vector<float>& range, const std::vector<std::uint8_t>& gap_before,
                       int neighbours, int i) {
  const int count = static_cast<int>(range.size());
  double sum = 0.0;
  for (const int direction : {-1, 1}) {
    int here = i;
    for (int k = 0; k < neighbours; ++k) {
      const int next = (here + direction + count) % count;
      if (gap_before[direction > 0 ? next : here]) return std::nan("");
      sum += static_cast<double>(range[next]) - range[i];
      here = next;
    }
  }
  return std::abs(sum) / (2.0 * neighbours * range[i]);
}

TEST(Roughness, IsEquationOne) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> range(2.0f, 50.0f);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<float> ranges;
    std::vector<std::uint8_t> gap_before;
    for (int i = 0; i < 360; ++i) {
      ranges.push_back(range(random));
      gap_before.push_back(random() % 40 == 0);
    }
    for (const int neighbours : {1, 5}) {
      const std::vector<float> c = roughness(ranges, gap_before, neighbours);
      int none = 0;
      for (int i = 0; i < static_cast<int>(c.size()); ++i) {
        const double expected = naive_roughness(ranges, gap_before, neighbours, i);
        EXPECT_EQ(std::isnan(c[i]), std::isnan(expected)) << i;
        none += std::isnan(expected);
        if (!std::isnan(expected)) {
          EXPECT_NEAR(c[i], expected, 1e-5 * (1.0 + expected)) << i;
        }
      }
      EXPECT_LT(none, static_cast<int>(c.size()));
    }
  }
}

TEST(Roughness, ARowOfFewPointsHasNone) {
  for (const int count : {0, 1, 10}) {
    const std::vector<std::uint8_t> no_gaps(count, 0);
    for (const float c : roughness(std::vector<float>(count, 5.0f), no_gaps, 5))
      EXPECT_TRUE(std::isnan(c));
  }
}

// Steps up to and beyond both limits, points that share a column and points of the ground, on
// sensors that see each, every second or every third column.
TEST(FeatureRow, AHolePartsObjectsSoonerThanTheGround) {
  std::mt19937 random(2);
  FeatureSettings settings;
  settings.max_column_gap = 2;
  settings.max_ground_gap = 10;
  for (int trial = 0; trial < 60; ++trial) {
    RangeImage image;
    image.rows = 1;
    image.column_step = 1 + trial % 3;
    Segmentation segmentation;
    int column = static_cast<int>(random() % 5);
    for (int i = 0; i < 200; ++i) {
      image.range.push_back(10.0f);
      image.column.push_back(static_cast<std::uint16_t>(column));
      segmentation.label.push_back(random() % 2 == 0 ? Label::ground : Label::segment);
      column += static_cast<int>(random() % (12 * image.column_step));
    }
    image.columns = column + 1;  // the seam is as wide as any step
    image.row_begin = {0, 200};
    FeatureRow row;
    row.load(image, segmentation, 0, settings, RoughnessThreshold(SensorModel{}, settings));
    ASSERT_EQ(row.size(), 200);
    for (int i = 0; i < 200; ++i) {
      const int before = (i + 199) % 200;
      const int step = (image.column[i] - image.column[before] + image.columns) % image.columns;
      const bool both_ground =
          segmentation.label[i] == Label::ground && segmentation.label[before] == Label::ground;
      EXPECT_EQ(row.gap_before[i] != 0, step > (both_ground ? 10 : 2) * image.column_step)
          << "trial " << trial << ", point " << i << ", step " << step;
    }
  }
}

TEST(Roughness, OfARightAngledCornerIsThatOfItsClosedForm) {
  // Walls that fall back by 45 degrees on both sides: r(a) = d / (cos a - sin |a|).
  constexpr double kStep = 0.2 * M_PI / 180.0;
  double expected = 0.0;
  for (int k = 1; k <= 5; ++k)
    expected += 2.0 * (1.0 / (std::cos(k * kStep) - std::sin(k * kStep)) - 1.0) / 10.0;
  EXPECT_NEAR(expected, 1.07e-2, 1e-4);
  for (const double distance : {2.0, 30.0}) {
    std::vector<float> range;
    for (int k = -20; k <= 20; ++k) {
      const double a = std::abs(k) * kStep;
      range.push_back(static_cast<float>(distance / (std::cos(a) - std::sin(a))));
    }
    const std::vector<std::uint8_t> no_gaps(range.size(), 0);
    EXPECT_NEAR(roughness(range, no_gaps, 5)[20], expected, 1e-5);
  }
}

}  // namespace
}  // namespace lego_loam_sc
