// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "core/pose.hpp"
#include "io/sensor_presets.hpp"
#include "io/sensor_yaml.hpp"
#include "io_test_files.hpp"
#include "sensor/recognise_sensor.hpp"

namespace lego_loam_sc {
namespace {

Eigen::Vector3f point_at(double elevation_deg, double azimuth_deg, double range) {
  const double elevation = radians(elevation_deg);
  const double azimuth = radians(azimuth_deg);
  return (range * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation)))
      .cast<float>();
}

// Ring after ring from the top, as KITTI stores them, or column after column, as drivers do.
enum class Order { by_ring, by_column };

Scan make_scan(const std::string& sensor_name, Order order, bool numbered) {
  const SensorModel sensor = load_sensor(sensor_name);
  constexpr int kColumns = 360;
  const int rows = sensor.rows();
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 0.02);
  Scan scan;
  for (int i = 0; i < rows * kColumns; ++i) {
    const int ring = order == Order::by_ring ? rows - 1 - i / kColumns : i % rows;
    const int column = order == Order::by_ring ? i % kColumns : i / rows;
    scan.points.push_back(
        point_at(sensor.elevation_deg[ring] + noise(random), column + 0.5, 5.0 + i % 37));
    if (i % 11 == 0) scan.points.back().setConstant(std::numeric_limits<float>::quiet_NaN());
    if (numbered) scan.ring.push_back(static_cast<std::uint16_t>(ring));
  }
  return scan;
}

std::string recognised(const Scan& scan) {
  return recognise_sensor(scan, sensor_presets()).name;
}

TEST(RecogniseSensor, ByTheElevationsOfItsPoints) {
  for (const bool numbered : {false, true}) {
    EXPECT_EQ(recognised(make_scan("vlp16", Order::by_column, numbered)), "vlp16");
    EXPECT_EQ(recognised(make_scan("hdl32e", Order::by_column, numbered)), "hdl32e");
  }
}

TEST(RecogniseSensor, KittiByItsOrderAndHdl64eByItsRings) {
  EXPECT_EQ(recognised(make_scan("kitti", Order::by_ring, false)), "kitti");
  EXPECT_EQ(recognised(make_scan("kitti", Order::by_column, true)), "hdl64e");
}

TEST(RecogniseSensor, TheFactsOfTheDatasetWin) {
  const Scan scan = make_scan("vlp16", Order::by_column, true);
  DatasetFacts facts;
  facts.motion_compensated = true;
  EXPECT_TRUE(recognise_sensor(scan, facts).motion_compensated);
  facts.sensor = "rs16";
  facts.elevation_correction_deg = 0.5;
  const SensorModel sensor = recognise_sensor(scan, facts);
  EXPECT_EQ(sensor.name, "rs16");
  EXPECT_EQ(sensor.elevation_correction_deg, 0.5);
}

TEST(RecogniseSensor, SaysWhatItSawWhenNothingFits) {
  Scan scan;
  for (int i = 0; i < 1000; ++i) scan.points.push_back(point_at(-40.0 + i * 0.08, i, 10.0));
  const std::string message = error_of([&] { recognised(scan); });
  EXPECT_NE(message.find("1000 points without ring numbers between -40.0 and 39.9 degrees"),
            message.npos)
      << message;
  EXPECT_NE(message.find("--sensor"), message.npos);
  EXPECT_THROW(recognised(Scan{}), InputError);
}

TEST(SensorMismatch, IsSilentWhenTheScanFits) {
  const Scan scan = make_scan("vlp16", Order::by_column, true);
  EXPECT_FALSE(sensor_mismatch(scan, load_sensor("vlp16")));
  EXPECT_FALSE(sensor_mismatch(Scan{}, load_sensor("vlp16")));
}

TEST(SensorMismatch, NamesTooManyRingsAndElevationsFarOutside) {
  const auto rings =
      sensor_mismatch(make_scan("hdl32e", Order::by_column, true), load_sensor("vlp16"));
  ASSERT_TRUE(rings);
  EXPECT_NE(rings->find("in 32 rings"), rings->npos);
  Scan upwards;
  for (int i = 0; i < 100; ++i) upwards.points.push_back(point_at(18.0, i, 10.0));
  EXPECT_TRUE(sensor_mismatch(upwards, load_sensor("vlp16")));
}

}  // namespace
}  // namespace lego_loam_sc
