// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/mounting.hpp"

#include <gtest/gtest.h>

#include "io/sensor_yaml.hpp"
#include "made_scenes.hpp"
#include "segmentation/ground.hpp"
#include "slam/match_scans.hpp"
#include "slam/slam.hpp"
#include "tracking/front_end.hpp"

namespace lego_loam_sc {
namespace {

SensorModel mounted(const std::string& preset, double roll_deg, double pitch_deg) {
  SensorModel sensor = load_sensor(preset);
  sensor.mount_roll_deg = roll_deg;
  sensor.mount_pitch_deg = pitch_deg;
  return sensor;
}

SensorModel untold(SensorModel sensor) {
  sensor.mount_roll_deg = sensor.mount_pitch_deg = sensor.height = 0.0;
  return sensor;
}

Pose pose_of_lidar(Pose T_world_base, const SensorModel& sensor) {
  return T_world_base.rotate(R_base_lidar(sensor));
}

// The mounting that one scan of `scene` shows.
SensorModel estimated(const Scene& scene, const SensorModel& truth, const Pose& T_world_base) {
  const Scan scan =
      take_scan(scene, truth, pose_of_lidar(T_world_base, truth), {.noise = 0.01, .seed = 6});
  SensorModel sensor = untold(truth);
  RangeImage image = project(scan, sensor);
  const bool found = estimate_tilt(image, sensor);
  EXPECT_EQ(found, sensor.tilted());
  if (sensor.tilted()) image = project(scan, sensor);
  sensor.height = estimate_sensor_height(image, sensor, {}).value_or(0.0);
  return sensor;
}

TEST(Mounting, TheGroundShowsTheTiltAndTheHeight) {
  for (const char* preset : {"vlp16", "hdl32e", "os1-64"})
    for (const auto& [roll, pitch] :
         {std::pair(0.0, 15.0), std::pair(-10.0, 8.0), std::pair(0.0, -30.0), std::pair(180.0, 0.0),
          std::pair(170.0, 5.0)}) {
      const SensorModel truth = mounted(preset, roll, pitch);
      const SensorModel found = estimated(street(), truth, pose_of(3, -1, 1.7, 20.0));
      const Eigen::Matrix3d error = R_base_lidar(found) * R_base_lidar(truth).transpose();
      EXPECT_LT(degrees(std::acos(error(2, 2))), 0.5) << preset << " " << roll << " " << pitch;
      EXPECT_NEAR(found.height, 1.7, 0.05) << preset << " " << roll << " " << pitch;
    }
}

TEST(Mounting, AnUprightSensorHasNoTilt) {
  for (const char* preset : {"vlp16", "hdl32e", "os0-128"})
    for (const Scene& scene : {street(), hall(), corridor()}) {
      const SensorModel found =
          estimated(scene, mounted(preset, 1.0, -2.0), pose_of(1, -1, 1.2, 20.0));
      EXPECT_FALSE(found.tilted()) << preset;
      EXPECT_NEAR(found.height, 1.2, 0.2);  // two degrees that stay are 0.17 m in 5 m
    }
}

TEST(Mounting, WithoutGroundNothingIsSaid) {
  Scene walls;
  walls.plane({5, 0, 0}, Eigen::Vector3d::UnitX()).plane({0, 4, 0}, Eigen::Vector3d::UnitY());
  EXPECT_FALSE(estimated(walls, mounted("vlp16", 0, 20), pose_of(0, 0, 0)).tilted());
}

TEST(Mounting, WhatTheModelStatesIsNotEstimated) {
  SensorModel sensor = load_sensor("vlp16");
  sensor.height = 1.5;
  const SensorModel tilted = mounted("vlp16", 0.0, 20.0);
  const Scan scan = take_scan(street(), tilted, pose_of_lidar(pose_of(0, 0, 1.5), tilted));
  EXPECT_FALSE(estimate_tilt(project(scan, sensor), sensor));
  EXPECT_FALSE(sensor.tilted());
}

// A drive round the pillars of the hall.
Pose base_at(double seconds) {
  return pose_of(-10.0 + 4.0 * seconds, 5.0 + std::sin(seconds), 1.5, 12.0 * seconds);
}

std::vector<Scan> drive(const SensorModel& sensor) {
  std::vector<Scan> scans;
  for (int k = 0; k < 25; ++k) {
    const auto pose_at = [&](double seconds) {
      return pose_of_lidar(base_at(0.1 * k + seconds), sensor);
    };
    scans.push_back(
        take_sweep(hall(), sensor, pose_at,
                   {.stamp_ns = std::int64_t{k} * 100'000'000, .noise = 0.01, .seed = 2}));
  }
  return scans;
}

TEST(Mounting, ATiltedSensorKeepsItsTrajectoryInALevelMap) {
  for (const auto& [roll, pitch] : {std::pair(0.0, 15.0), std::pair(180.0, 0.0)}) {
    const SensorModel truth = mounted("vlp16", roll, pitch);
    const std::vector<Scan> scans = drive(truth);
    // Told, and found from the scans; the hall's ceiling could be the ground of the one upside
    // down.
    for (const SensorModel& given : {truth, untold(truth)}) {
      if (roll == 180.0 && !given.tilted()) continue;
      Slam slam(given, {});
      for (const Scan& scan : scans) EXPECT_LE(slam.process(scan).status, Status::degenerate);
      const Trajectory trajectory = slam.trajectory();
      ASSERT_EQ(trajectory.size(), scans.size());
      const Pose T_map_world = pose_of_lidar(base_at(0.0), truth).inverse();
      const Pose expected = T_map_world * pose_of_lidar(base_at(2.4), truth);
      const Pose found = trajectory.front().pose.inverse() * trajectory.back().pose;
      const Pose error = expected.inverse() * found;
      EXPECT_LT(error.translation().norm(), 0.05) << roll << " " << pitch;
      EXPECT_LT(degrees(rotation_angle(error)), 0.5) << roll << " " << pitch;
      // The map is level: the vehicle stays at one height in it, and the first pose is tilted.
      EXPECT_NEAR(trajectory.back().pose.translation().z(), 0.0, 0.05);
      EXPECT_TRUE(
          trajectory.front().pose.linear().row(2).isApprox(slam.R_level_lidar().row(2), 0.01));
      EXPECT_NEAR(slam.sensor_height(), 1.5, 0.1);
    }
  }
}

TEST(Mounting, ATiltThatTheSecondScanContradictsIsNone) {
  const SensorModel tilted = mounted("vlp16", 0.0, 15.0), upright = load_sensor("vlp16");
  Slam slam(untold(tilted), {});
  slam.process(take_scan(hall(), tilted, pose_of_lidar(base_at(0.0), tilted)));
  EXPECT_TRUE(slam.calibration().tilt_is_estimated());
  slam.process(take_scan(hall(), upright, base_at(0.0), {.stamp_ns = 100'000'000}));
  EXPECT_FALSE(slam.calibration().sensor.tilted());
}

TEST(Mounting, TheFrontEndLevelsASensorAndFindsItsHeight) {
  const SensorModel truth = mounted("vlp16", 0.0, 15.0);
  const Scan scan = take_scan(hall(), truth, pose_of_lidar(base_at(0.0), truth));
  const FrontEnd expected = run_front_end(scan, truth, 1.5, {}, true);
  const FrontEnd front = run_front_end(scan, untold(truth), 0.0, {}, true);
  EXPECT_EQ(expected.mounting.height, 1.5);
  EXPECT_EQ(expected.mounting.pitch_deg, truth.mount_pitch_deg);
  EXPECT_NEAR(front.mounting.height, 1.5, 0.1);
  EXPECT_NEAR(front.mounting.pitch_deg, 15.0, 1.0);
  const auto ground = static_cast<double>(expected.segmentation.ground_points);
  EXPECT_GT(ground, 0.1 * static_cast<double>(expected.image.size()));
  EXPECT_NEAR(static_cast<double>(front.segmentation.ground_points), ground, 0.05 * ground);
}

TEST(Mounting, TwoScansOfATiltedSensorMatchInItsOwnAxes) {
  const SensorModel truth = mounted("os1-64", 0.0, 15.0);
  const Pose a = pose_of_lidar(pose_of(2, 4, 1.5, 10.0), truth);
  const Pose b = pose_of_lidar(pose_of(3, 3.5, 1.5, 170.0), truth);
  const ScanMatch match =
      match_scans(take_scan(hall(), truth, a), take_scan(hall(), truth, b), untold(truth), {});
  EXPECT_EQ(match.verification.verdict, Verdict::accepted);
  const Pose error = (a.inverse() * b).inverse() * match.verification.T_match_query;
  EXPECT_LT(error.translation().norm(), 0.05);
  EXPECT_LT(degrees(rotation_angle(error)), 0.5);
}

}  // namespace
}  // namespace lego_loam_sc
