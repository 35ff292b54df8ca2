// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/range_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "core/azimuth.hpp"
#include "made_scenes.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

std::vector<std::size_t> numbers(const Scan& scan) {
  std::vector<std::size_t> order(scan.size());
  std::iota(order.begin(), order.end(), 0);
  return order;
}

Scan in_order(const Scan& scan, const std::vector<std::size_t>& order) {
  Scan result;
  result.stamp_ns = scan.stamp_ns;
  for (const std::size_t i : order) {
    result.points.push_back(scan.points[i]);
    result.intensity.push_back(scan.intensity[i]);
    result.ring.push_back(scan.ring[i]);
    if (!scan.offset_ns.empty()) result.offset_ns.push_back(scan.offset_ns[i]);
  }
  return result;
}

Scan shuffled(const Scan& scan, unsigned seed) {
  std::vector<std::size_t> order = numbers(scan);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  return in_order(scan, order);
}

void add_point(Scan& scan, const Vector3f& point, std::uint16_t ring, std::int32_t offset_ns) {
  scan.points.push_back(point);
  scan.intensity.push_back(static_cast<float>(scan.size() - 1));
  scan.ring.push_back(ring);
  scan.offset_ns.push_back(offset_ns);
}

// Sweep of a hall whose intensities number the points.
Scan numbered_sweep() {
  Scan scan = take_sweep(hall(), made_sensor(900), [](double) { return pose_of(1, 4, 1.8, 20.0); },
                         {.stamp_ns = 7'000'000'000});
  for (std::size_t i = 0; i < scan.size(); ++i) scan.intensity[i] = static_cast<float>(i);
  return scan;
}

void expect_same(const RangeImage& image, const RangeImage& expected) {
  EXPECT_EQ(image.points, expected.points);
  EXPECT_EQ(image.intensity, expected.intensity);
  EXPECT_EQ(image.time, expected.time);
  EXPECT_EQ(image.column, expected.column);
  EXPECT_EQ(image.row_begin, expected.row_begin);
  EXPECT_EQ(image.pixels, expected.pixels);
  EXPECT_EQ(image.reference_ns, expected.reference_ns);
}

TEST(FastAtan2, IsTheArcusTangentToAHundredthOfAColumn) {
  for (int k = -3600; k <= 3600; ++k) {
    for (const double radius : {1e-3, 1.0, 120.0}) {
      const double angle = radians(0.05 * k);
      const auto y = static_cast<float>(radius * std::sin(angle));
      const auto x = static_cast<float>(radius * std::cos(angle));
      EXPECT_NEAR(fast_atan2(y, x), std::atan2(y, x), 1e-5);
    }
  }
  EXPECT_EQ(fast_atan2(0.0f, 0.0f), 0.0f);
}

TEST(RangeImage, EveryAttributeFollowsItsPoint) {
  const Scan numbered = numbered_sweep();
  const SensorModel sensor = made_sensor(900);
  const RangeImage image = project(shuffled(numbered, 1), sensor);
  ASSERT_EQ(image.size(), numbered.size());
  for (std::size_t k = 0; k < image.size(); ++k) {
    const auto i = static_cast<std::size_t>(image.intensity[k]);
    EXPECT_EQ(image.points[k], numbered.points[i]);
    EXPECT_FLOAT_EQ(image.range[k], numbered.points[i].norm());
    const std::int64_t time =
        image.reference_ns + std::llround(1e9 * static_cast<double>(image.time[k]));
    EXPECT_NEAR(static_cast<double>(time - numbered.stamp_ns), numbered.offset_ns[i], 10.0);
    const auto row = std::upper_bound(image.row_begin.begin(), image.row_begin.end(), k) -
                     image.row_begin.begin() - 1;
    EXPECT_EQ(row, numbered.ring[i]);
  }
}

// Sweeps that turn either way, begin anywhere, have a few points late, or no order at all.
TEST(RangeImage, TheOrderOfThePointsInTheScanDoesNotMatter) {
  const Scan scan = numbered_sweep();
  const SensorModel sensor = made_sensor(900);
  const RangeImage expected = project(scan, sensor);
  std::vector<std::size_t> backwards = numbers(scan);
  std::ranges::reverse(backwards);
  std::vector<std::size_t> begun_elsewhere = backwards;
  std::ranges::rotate(begun_elsewhere, begun_elsewhere.begin() + begun_elsewhere.size() / 3);
  std::vector<std::size_t> some_late = numbers(scan);
  for (std::size_t i = 0; i + 100 < some_late.size(); i += 500)
    std::swap(some_late[i], some_late[i + 99]);
  for (const Scan& other : {in_order(scan, backwards), in_order(scan, begun_elsewhere),
                            in_order(scan, some_late), shuffled(scan, 3)})
    expect_same(project(other, sensor), expected);
}

TEST(RangeImage, APointStraightBackIsTheFirstOfItsRow) {
  Scan scan;
  for (const float y : {1.0f, 0.0f, -1.0f}) add_point(scan, {-5.0f, y, 0.0f}, 0, 0);
  for (const float y : {1.0f, -1.0f}) add_point(scan, {5.0f, y, 1.0f}, 1, 0);
  const RangeImage image = project(scan, made_sensor(900));
  ASSERT_EQ(image.size(), 5U);
  EXPECT_EQ(image.intensity, (std::vector<float>{1, 2, 0, 4, 3}));
  EXPECT_EQ(image.column[0], 0);
}

TEST(RangeImage, PointsThatAreNotFiniteTooNearOrTooFarGoWithAllTheirAttributes) {
  const SensorModel sensor = made_sensor(900);
  const Scan good = numbered_sweep();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<Vector3f> bad{{nan, 1, 1},      {1, nan, 1},   {1, 1, nan},
                                  {infinity, 0, 0}, {0, 0, 0},     {0.3f, 0, 0},
                                  {0, -101.0f, 0},  {1e30f, 0, 0}, {0, 1, -infinity}};
  Scan mixed;
  mixed.stamp_ns = good.stamp_ns;
  for (std::size_t i = 0; i < good.size(); ++i) {
    if (i % 3 == 0) add_point(mixed, bad[i / 3 % bad.size()], good.ring[i], 2'000'000'000);
    mixed.points.push_back(good.points[i]);
    mixed.intensity.push_back(good.intensity[i]);
    mixed.ring.push_back(good.ring[i]);
    mixed.offset_ns.push_back(good.offset_ns[i]);
  }
  expect_same(project(mixed, sensor), project(good, sensor));
}

TEST(RangeImage, RowsAscendInAzimuthAndPixelsAgreeWithThem) {
  const SensorModel sensor = made_sensor(900);
  const RangeImage image = project(shuffled(numbered_sweep(), 2), sensor);
  ASSERT_EQ(image.row_begin.size(), 17u);
  EXPECT_EQ(image.row_begin.front(), 0u);
  EXPECT_EQ(image.row_begin.back(), image.size());
  for (int row = 0; row < image.rows; ++row) {
    for (std::uint32_t k = image.row_begin[row]; k < image.row_begin[row + 1]; ++k) {
      const double azimuth = std::atan2(image.points[k].y(), image.points[k].x());
      EXPECT_EQ(image.column[k], static_cast<int>((azimuth + M_PI) / (2.0 * M_PI) * 900));
      EXPECT_EQ(image.pixel(row, image.column[k]), static_cast<std::int32_t>(k));
      if (k > image.row_begin[row]) {
        EXPECT_GT(azimuth, std::atan2(image.points[k - 1].y(), image.points[k - 1].x()));
      }
    }
  }
  EXPECT_EQ(static_cast<std::size_t>(std::count_if(image.pixels.begin(), image.pixels.end(),
                                                   [](int p) { return p >= 0; })),
            image.size());
}

TEST(RangeImage, TheNearestOfThePointsOfAPixelStandsForIt) {
  const SensorModel sensor = made_sensor(900);
  const Vector3d direction = beam(column_azimuth(sensor, 450), radians(1.0));
  Scan scan;
  for (const double range : {9.0, 4.0, 6.0})
    add_point(scan, (range * direction).cast<float>(), 8, 0);
  const RangeImage image = project(scan, sensor);
  ASSERT_EQ(image.size(), 3u);  // none is thrown away
  ASSERT_GE(image.pixel(8, 450), 0);
  EXPECT_NEAR(image.range[image.pixel(8, 450)], 4.0, 1e-5);
}

TEST(RangeImage, TheElevationCorrectionTurnsByThatAngleAndKeepsRangeAndAzimuth) {
  SensorModel sensor = made_sensor(900);
  sensor.elevation_correction_deg = 0.205;
  const Scan scan = numbered_sweep();
  const RangeImage image = project(scan, sensor);
  for (std::size_t k = 0; k < image.size(); ++k) {
    const Vector3d before =
        scan.points[static_cast<std::size_t>(image.intensity[k])].cast<double>();
    const Vector3d after = image.points[k].cast<double>();
    EXPECT_NEAR(after.norm(), before.norm(), 1e-5 * before.norm());
    EXPECT_NEAR(std::atan2(after.y(), after.x()), std::atan2(before.y(), before.x()), 1e-6);
    const double raised =
        std::asin(after.z() / after.norm()) - std::asin(before.z() / before.norm());
    EXPECT_NEAR(degrees(raised), 0.205, 1e-3);
  }
}

TEST(RangeImage, AgesCountFromTheMiddleOfTheSweep) {
  Scan scan = numbered_sweep();
  const auto [first, last] = std::minmax_element(scan.offset_ns.begin(), scan.offset_ns.end());
  const std::int64_t middle = (std::int64_t{*first} + *last) / 2;
  const SensorModel sensor = made_sensor(900);
  const RangeImage image = project(scan, sensor);
  EXPECT_NEAR(static_cast<double>(image.reference_ns - scan.stamp_ns), static_cast<double>(middle),
              1.0);
  // Times before the stamp, as of drivers that stamp the end, say the same.
  for (std::int32_t& offset : scan.offset_ns) offset -= 100'000'000;
  scan.stamp_ns += 100'000'000;
  const RangeImage shifted = project(scan, sensor);
  EXPECT_EQ(shifted.reference_ns, image.reference_ns);
  EXPECT_EQ(shifted.time, image.time);
  EXPECT_EQ(shifted.stamp_ns, image.stamp_ns + 100'000'000);
}

TEST(RangeImage, TheAzimuthTellsTheAgeOfARawSweepWithoutTimes) {
  for (const bool clockwise : {true, false}) {
    for (const double start_deg : {180.0, 0.0, -77.0}) {
      SensorModel sensor = made_sensor(900);
      sensor.clockwise = clockwise;
      sensor.start_azimuth_deg = start_deg;
      Scan scan = take_sweep(hall(), sensor, [](double) { return pose_of(1, 4, 1.8); });
      std::vector<std::int32_t> times;
      times.swap(scan.offset_ns);
      for (std::size_t i = 0; i < scan.size(); ++i) scan.intensity[i] = static_cast<float>(i);
      sensor.times_from_azimuth = true;
      const RangeImage image = project(scan, sensor);
      EXPECT_EQ(image.reference_ns - scan.stamp_ns, 50'000'000);
      for (std::size_t k = 0; k < image.size(); ++k)
        EXPECT_NEAR(image.time[k],
                    1e-9 * times[static_cast<std::size_t>(image.intensity[k])] - 0.05, 1e-6);
    }
  }
}

TEST(RangeImage, CompensatedScansAndScansWithoutTimesHaveNoAges) {
  Scan scan = numbered_sweep();
  SensorModel sensor = made_sensor(900);
  sensor.motion_compensated = true;
  const auto expect_no_ages = [&] {
    const RangeImage image = project(scan, sensor);
    EXPECT_EQ(image.reference_ns, scan.stamp_ns);
    EXPECT_EQ(std::count(image.time.begin(), image.time.end(), 0.0f),
              static_cast<std::ptrdiff_t>(scan.size()));
  };
  expect_no_ages();
  sensor.motion_compensated = false;
  scan.offset_ns.clear();
  expect_no_ages();
}

TEST(RangeImage, TheUsualStepIsThatOfMostPoints) {
  const SensorModel sensor = made_sensor(900);
  for (const int step : {1, 2, 3}) {
    Scan scan;
    for (int column = 0; column < sensor.columns; column += step) {
      if (column % 50 < 20) continue;  // holes
      const double azimuth = 2.0 * M_PI * (column + 0.5) / sensor.columns;
      const Vector3d point(std::cos(azimuth), std::sin(azimuth),
                           std::tan(radians(sensor.elevation_deg[8])));
      add_point(scan, (10.0 * point).cast<float>(), 8, 0);
    }
    EXPECT_EQ(project(scan, sensor).column_step, step);
  }
}

TEST(RangeImage, AnEmptyScanIsAnEmptyImage) {
  const RangeImage image = project({}, made_sensor(900));
  EXPECT_EQ(image.size(), 0u);
  EXPECT_EQ(image.pixels.size(), 16u * 900u);
  EXPECT_EQ(image.row_begin, std::vector<std::uint32_t>(17, 0));
}

}  // namespace
}  // namespace lego_loam_sc
