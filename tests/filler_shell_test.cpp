// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/filler_shell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "made_scenes.hpp"
#include "segmentation/remove_points.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kNoise = 0.01;

// As some drivers give it: a point at `filler` metres where there is no return.
Scan with_fillers(const SensorModel& sensor, double x, double filler, std::uint64_t seed) {
  SensorModel far = sensor;
  far.max_range = 1e9;
  Scan scan = take_scan(street(), far, pose_of(x, 0, kMadeHeight), {0, kNoise, seed});
  // The sky is not in a scan at all.
  std::vector<bool> seen(static_cast<std::size_t>(sensor.rows()) * sensor.columns);
  const RangeImage image = project(scan, sensor);
  for (std::size_t k = 0; k < seen.size(); ++k) seen[k] = image.pixels[k] >= 0;
  for (int row = 0; row < sensor.rows(); ++row) {
    for (int column = 0; column < sensor.columns; ++column) {
      if (seen[static_cast<std::size_t>(row) * sensor.columns + column]) continue;
      scan.points.push_back(
          (filler * beam(column_azimuth(sensor, column), radians(sensor.elevation_deg[row])))
              .cast<float>());
      scan.intensity.push_back(0.0F);
      scan.ring.push_back(static_cast<std::uint16_t>(row));
    }
  }
  return scan;
}

TEST(FillerShell, FindsPointsAtOneRangeFromTheFirstScanOn) {
  const SensorModel sensor = made_sensor(900);
  for (const double range : {30.0, 99.0}) {
    FillerShell shell(sensor);
    for (int k = 0; k < 4; ++k) {
      RangeImage image = project(with_fillers(sensor, 0.5 * k, range, k), sensor);
      const std::size_t before = image.size();
      std::vector<std::uint8_t> remove(before, 0);
      shell.observe(image);
      const std::size_t count = shell.mark(image, remove);
      EXPECT_GT(count, before / 20);
      remove_points(remove, image);
      EXPECT_EQ(image.size(), before - count);
      for (const float r : image.range) EXPECT_GT(std::abs(r - range), 0.02);
    }
    ASSERT_TRUE(shell.range().has_value());
    EXPECT_NEAR(*shell.range(), range, 0.01);
  }
}

TEST(FillerShell, TakesNoSurfaceForIt) {
  const SensorModel sensor = made_sensor(900);
  Scene silo;  // the sensor in the middle: a pole that is seen from within, and the ground
  silo.plane({0, 0, 0}, Eigen::Vector3d::UnitZ()).pole(0, 0, 6.0, 0, 30);
  Scene wall;
  wall.plane({0, 0, 0}, Eigen::Vector3d::UnitZ()).plane({12, 0, 0}, Eigen::Vector3d::UnitX());
  Scene room;
  room.box({-3, -3, 0}, {3, 3, 3});
  for (const Scene& scene : {street(), hall(), corridor(), silo, wall, room}) {
    FillerShell shell(sensor);
    for (int k = 0; k < 4; ++k) {
      const RangeImage image = project(
          take_scan(scene, sensor, pose_of(0, 0, 1.5), {0, kNoise, std::uint64_t(k)}), sensor);
      std::vector<std::uint8_t> remove(image.size(), 0);
      shell.observe(image);
      EXPECT_EQ(shell.mark(image, remove), 0U);
    }
  }
}

TEST(RemovePoints, LeavesTheOthersAndTheirPixels) {
  const SensorModel sensor = made_sensor(360);
  const RangeImage all = project(take_scan(hall(), sensor, pose_of(0, 2, 1.5)), sensor);
  std::vector<std::uint8_t> remove(all.size(), 0);
  for (std::size_t i = 0; i < remove.size(); i += 3) remove[i] = 1;
  RangeImage image = all;
  remove_points(remove, image);
  ASSERT_EQ(image.row_begin.back(), image.size());
  std::size_t kept = 0;
  for (int row = 0; row < all.rows; ++row) {
    for (std::uint32_t i = all.row_begin[row]; i < all.row_begin[row + 1]; ++i) {
      const std::int32_t pixel = image.pixel(row, all.column[i]);
      if (remove[i]) {
        EXPECT_EQ(pixel, -1);
        continue;
      }
      EXPECT_EQ(image.points[kept], all.points[i]);
      EXPECT_EQ(pixel, static_cast<std::int32_t>(kept));
      ++kept;
    }
  }
  EXPECT_EQ(kept, image.size());
}

}  // namespace
}  // namespace lego_loam_sc
