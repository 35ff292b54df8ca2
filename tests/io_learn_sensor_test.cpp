// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "io/presets.hpp"
#include "io/sensor_presets.hpp"
#include "io/sensor_yaml.hpp"
#include "io_test_files.hpp"
#include "made_scenes.hpp"
#include "preset_name.hpp"
#include "sensor/learn_sensor.hpp"
#include "sensor/recognise_sensor.hpp"

namespace lego_loam_sc {
namespace {

std::vector<Scan> scans_of(const SensorModel& sensor) {
  std::vector<Scan> scans;
  for (int k = 0; k < 3; ++k) {
    const auto pose_at = [k](double seconds) {
      return pose_of(-3.0 + k + 8.0 * seconds, 4.0, 1.8, 20.0 * k);
    };
    scans.push_back(
        take_sweep(hall(), sensor, pose_at,
                   {.stamp_ns = k * 100'000'000, .noise = sensor.range_noise, .seed = 7}));
  }
  return scans;
}

void expect_beams(const SensorModel& learned, const SensorModel& truth) {
  ASSERT_EQ(learned.rows(), truth.rows());
  for (int row = 0; row < truth.rows(); ++row)
    EXPECT_NEAR(learned.elevation_deg[row], truth.elevation_deg[row], 0.05) << "row " << row;
}

class LearnSensor : public testing::TestWithParam<std::string> {};

TEST_P(LearnSensor, FindsThePresetBehindScansWithAndWithoutRings) {
  const SensorModel truth = load_sensor(GetParam());
  std::vector<Scan> scans = scans_of(truth);
  const SensorModel learned = learn_sensor(scans, sensor_presets()).sensor;
  expect_beams(learned, truth);
  EXPECT_NEAR(learned.columns, truth.columns, 1);
  EXPECT_EQ(learned.period, 0.1);
  EXPECT_EQ(learned.clockwise, truth.clockwise);
  EXPECT_LT(std::abs(std::remainder(learned.start_azimuth_deg - truth.start_azimuth_deg, 360)),
            1.5);
  for (Scan& scan : scans) scan.ring.clear();
  expect_beams(learn_sensor(scans, sensor_presets()).sensor, truth);
}

INSTANTIATE_TEST_SUITE_P(All, LearnSensor, testing::ValuesIn(preset_names("sensors")), preset_name);

bool has_note(const LearnedSensor& learned, const std::string& words) {
  for (const std::string& note : learned.notes)
    if (note.find(words) != note.npos) return true;
  return false;
}

TEST(LearnSensor, SaysWhichPresetIsNearest) {
  SensorModel unit = load_sensor("pandar64");
  std::mt19937 random(2);
  std::uniform_real_distribution<double> error(-0.07, 0.07);
  for (double& elevation : unit.elevation_deg) elevation += error(random);
  EXPECT_TRUE(
      has_note(learn_sensor(scans_of(unit), sensor_presets()), "the nearest preset is pandar64"));
  EXPECT_EQ(recognise_sensor(scans_of(unit)[0], sensor_presets()).name, "pandar64");
}

TEST(LearnSensor, ASensorThatTurnsTheOtherWay) {
  SensorModel sensor = load_sensor("vlp16");
  sensor.clockwise = false;
  sensor.start_azimuth_deg = 90.0;
  sensor.min_range = 0.1;
  const SensorModel learned = learn_sensor(scans_of(sensor), sensor_presets()).sensor;
  EXPECT_FALSE(learned.clockwise);
  EXPECT_NEAR(learned.start_azimuth_deg, 90.0, 1.0);
}

TEST(LearnSensor, BeamsThatAreMountedOffTheCentreAreNotSplit) {
  // Near the sensor each beam spreads over half a degree.
  const SensorModel truth = load_sensor("vlp16");
  std::vector<Scan> scans;
  Scene room;
  room.box({-2, -1, -1}, {3, 5, 2});
  scans.push_back(take_scan(room, truth, pose_of(0, 0, 0)));
  for (Scan& scan : scans) {
    for (std::size_t i = 0; i < scan.size(); ++i)
      scan.points[i].z() -= 0.0007f * static_cast<float>(truth.elevation_deg[scan.ring[i]]);
    scan.ring.clear();
  }
  EXPECT_EQ(learn_sensor(scans, sensor_presets()).sensor.rows(), 16);
}

TEST(LearnSensor, TheBlindRangeIsWhereTheNearestReturnsAre) {
  SensorModel sensor = load_sensor("vlp16");
  Scene room;
  room.box({-0.65, -3, -1}, {3, 5, 2});
  const std::vector<Scan> near = {take_scan(room, sensor, pose_of(0, 0, 0))};
  EXPECT_NEAR(learn_sensor(near, sensor_presets()).sensor.min_range, 0.6, 1e-9);
  const LearnedSensor far = learn_sensor(scans_of(sensor), sensor_presets());
  EXPECT_EQ(far.sensor.min_range, 1.0);
  EXPECT_TRUE(has_note(far, "no return was close enough to show the blind zone"));
}

// A rosette: each of the six lines sweeps the whole field of view, as a Livox Avia's do.
std::vector<Scan> rosette(bool with_lines) {
  Scan scan;
  for (int i = 0; i < 24000; ++i) {
    const double t = 0.001 * i;
    const double elevation = radians(30.0 * std::sin(7.3 * t) * std::cos(1.7 * t));
    const double azimuth = radians(35.0 * std::cos(7.3 * t) * std::cos(1.7 * t));
    scan.points.push_back((8.0 * beam(azimuth, elevation)).cast<float>());
    if (with_lines) scan.ring.push_back(static_cast<std::uint16_t>(i % 6));
  }
  return {scan};
}

TEST(LearnSensor, ASensorThatDoesNotSpinIsRefusedByNameWithTheReason) {
  for (const bool with_lines : {true, false}) {
    const std::string message =
        error_of([&] { learn_sensor(rosette(with_lines), sensor_presets()); });
    EXPECT_NE(message.find("Livox"), message.npos) << message;
    EXPECT_NE(message.find("spin"), message.npos) << message;
  }
  const Scan scan = rosette(true)[0];
  for (const std::string& message : {error_of([&] { recognise_sensor(scan, sensor_presets()); }),
                                     *sensor_mismatch(scan, load_sensor("vlp16"))})
    EXPECT_NE(message.find("degrees of elevation, so the ring field does not number beams"),
              message.npos)
        << message;
}

TEST(LearnSensor, TooFewPointsAreRefused) {
  EXPECT_NE(error_of([] { learn_sensor({}, sensor_presets()); }).find("0 points with a return"),
            std::string::npos);
}

}  // namespace
}  // namespace lego_loam_sc
