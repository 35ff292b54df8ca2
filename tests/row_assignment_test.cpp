// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/row_assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

#include "made_scenes.hpp"

namespace lego_loam_sc {
namespace {

constexpr std::uint16_t kRoboSense[16] = {0, 15, 1, 14, 2, 13, 3, 12, 4, 11, 5, 10, 6, 9, 7, 8};

// A ring field of true rows, from a sensor whose beams are all mounted a little too high.
Scan scan_with_true_rows(const SensorModel& sensor) {
  SensorModel biased = sensor;
  for (double& elevation : biased.elevation_deg) elevation += 0.3;
  return take_scan(hall(), biased, pose_of(1, 4, 1.8, 20.0));
}

std::vector<std::int16_t> rows_of(const Scan& scan, const SensorModel& sensor) {
  return assign_rows(scan, std::vector<std::uint8_t>(scan.size(), 1), sensor);
}

void expect_rows(const std::vector<std::int16_t>& rows, const std::vector<std::uint16_t>& truth) {
  ASSERT_EQ(rows.size(), truth.size());
  for (std::size_t i = 0; i < rows.size(); ++i) ASSERT_EQ(rows[i], truth[i]) << "point " << i;
}

TEST(RowAssignment, ARingFieldInAnyNumberingFindsTheRows) {
  const SensorModel sensor = made_sensor(360);
  const Scan scan = scan_with_true_rows(sensor);
  for (const auto& number :
       {+[](std::uint16_t row) { return row; },
        +[](std::uint16_t row) { return static_cast<std::uint16_t>(15 - row); },
        +[](std::uint16_t row) { return kRoboSense[row]; },
        +[](std::uint16_t row) { return static_cast<std::uint16_t>(3 * row + 100); }}) {
    Scan renumbered = scan;
    for (std::uint16_t& ring : renumbered.ring) ring = number(ring);
    expect_rows(rows_of(renumbered, sensor), scan.ring);
  }
}

// Many points, of which not each is looked at: ring after ring, column by column.
TEST(RowAssignment, RingsThatTakeTurnsAreAllFoundWhateverTheirNumber) {
  for (const int rows : {14, 16, 21, 64}) {
    SensorModel sensor;
    sensor.elevation_deg.clear();
    for (int row = 0; row < rows; ++row) sensor.elevation_deg.push_back(row - 0.5 * rows);
    Scan scan;
    for (int i = 0; i < 30'000; ++i) {
      const double elevation = radians(sensor.elevation_deg[i % rows] + 0.2);
      const double azimuth = 1e-4 * i;
      scan.points.push_back(Eigen::Vector3d(10.0 * std::cos(azimuth), 10.0 * std::sin(azimuth),
                                            10.0 * std::tan(elevation))
                                .cast<float>());
      scan.ring.push_back(static_cast<std::uint16_t>(i % rows));
    }
    expect_rows(rows_of(scan, sensor), scan.ring);
  }
}

TEST(RowAssignment, MissingRingsShiftNoOther) {
  const SensorModel sensor = made_sensor(360);
  const Scan scan = scan_with_true_rows(sensor);
  for (const std::vector<int>& missing :
       {std::vector<int>{0}, std::vector<int>{15}, std::vector<int>{0, 1, 2, 9, 15}}) {
    Scan rest;
    std::vector<std::uint16_t> truth;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (std::count(missing.begin(), missing.end(), scan.ring[i])) continue;
      rest.points.push_back(scan.points[i]);
      rest.ring.push_back(kRoboSense[scan.ring[i]]);
      truth.push_back(scan.ring[i]);
    }
    expect_rows(rows_of(rest, sensor), truth);
  }
}

TEST(RowAssignment, PointsWithoutPositionDoNotMisleadTheRings) {
  const SensorModel sensor = made_sensor(360);
  Scan scan = scan_with_true_rows(sensor);
  std::vector<std::uint8_t> usable(scan.size(), 1);
  for (std::size_t i = 0; i < scan.size(); i += 2) {
    scan.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
    usable[i] = 0;
  }
  const std::vector<std::int16_t> rows = assign_rows(scan, usable, sensor);
  for (std::size_t i = 1; i < scan.size(); i += 2) ASSERT_EQ(rows[i], scan.ring[i]);
}

// Ring by ring from the top, each counter-clockwise from straight ahead, as KITTI's files are.
Scan stored_as_kitti_does(const SensorModel& sensor, const std::vector<int>& missing,
                          std::vector<std::uint16_t>& truth) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2), turn(0.0, 1.0);
  const Scene scene = hall();
  Scan scan;
  for (int row = sensor.rows() - 1; row >= 0; --row) {
    if (std::count(missing.begin(), missing.end(), row)) continue;
    // Real rings are off their table, by up to half the distance to the next.
    const double off = jitter(random);
    for (int k = 0; k < 500; ++k) {
      if (turn(random) < 0.05) continue;
      const Eigen::Vector3d direction =
          beam(2.0 * M_PI * (k + 0.5) / 500, radians(sensor.elevation_deg[row] + off));
      const double range = scene.range({1.0, 4.0, 1.8}, direction);
      scan.points.push_back((range * direction).cast<float>());
      truth.push_back(static_cast<std::uint16_t>(row));
    }
  }
  return scan;
}

SensorModel sixty_four_beams() {
  SensorModel sensor = made_sensor(2048);
  sensor.elevation_deg.clear();
  for (int row = 0; row < 64; ++row) sensor.elevation_deg.push_back(-24.8 + 26.8 * row / 63.0);
  return sensor;
}

TEST(RowAssignment, TheOrderOfStorageFindsTheRowsOfKittisFiles) {
  std::vector<std::uint16_t> truth;
  const Scan scan = stored_as_kitti_does(sixty_four_beams(), {}, truth);
  expect_rows(rows_of(scan, sixty_four_beams()), truth);
}

TEST(RowAssignment, ARingThatIsMissingInAFileShiftsAtMostTheRingsNextToIt) {
  for (const std::vector<int>& missing : {std::vector<int>{63}, std::vector<int>{20, 21, 22}}) {
    std::vector<std::uint16_t> truth;
    const Scan scan = stored_as_kitti_does(sixty_four_beams(), missing, truth);
    const std::vector<std::int16_t> rows = rows_of(scan, sixty_four_beams());
    std::size_t right = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_LE(std::abs(rows[i] - truth[i]), 1);
      right += rows[i] == truth[i];
    }
    EXPECT_GT(static_cast<double>(right), 0.9 * static_cast<double>(rows.size()));
  }
}

TEST(RowAssignment, WithoutRingsAndOrderTheElevationDecides) {
  const SensorModel sensor = made_sensor(360);
  Scan scan = take_scan(hall(), sensor, pose_of(1, 4, 1.8, 20.0));  // column after column
  const std::vector<std::uint16_t> truth = scan.ring;
  scan.ring.clear();
  expect_rows(rows_of(scan, sensor), truth);
}

TEST(RowAssignment, APointMoreThanHalfASpacingFromItsBeamBelongsToNoRow) {
  SensorModel sensor = made_sensor(360);
  sensor.elevation_deg = {-10.0, -8.0, -2.0};
  const auto row_at = [&](double elevation_deg) {
    Scan scan;
    scan.points.push_back((5.0 * beam(1.0, radians(elevation_deg))).cast<float>());
    return rows_of(scan, sensor)[0];
  };
  EXPECT_EQ(row_at(-11.2), -1);
  EXPECT_EQ(row_at(-10.8), 0);
  EXPECT_EQ(row_at(-9.1), 0);
  EXPECT_EQ(row_at(-8.9), 1);
  EXPECT_EQ(row_at(-5.2), 1);
  EXPECT_EQ(row_at(-4.8), 2);
  EXPECT_EQ(row_at(0.8), 2);
  EXPECT_EQ(row_at(1.2), -1);
  EXPECT_EQ(row_at(89.9), -1);
  EXPECT_EQ(row_at(-90.0), -1);
}

TEST(RowAssignment, ARingFieldThatSaysNothingIsNotBelieved) {
  // Some converters write a field of zeros.
  const SensorModel sensor = made_sensor(360);
  Scan scan = take_scan(hall(), sensor, pose_of(1, 4, 1.8, 20.0));
  const std::vector<std::uint16_t> truth = scan.ring;
  std::fill(scan.ring.begin(), scan.ring.end(), std::uint16_t{0});
  expect_rows(rows_of(scan, sensor), truth);
}

TEST(RowAssignment, NothingHasNoRows) {
  EXPECT_TRUE(rows_of({}, made_sensor()).empty());
}

}  // namespace
}  // namespace lego_loam_sc
