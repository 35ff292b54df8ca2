// SPDX-License-Identifier: BSD-3-Clause
#include "sim/recorded_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "io/trajectory.hpp"
#include "io_test_files.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double radius = 40.0, speed = 8.0, climb = 0.5;

Pose pose_at(double time) {
  const double angle = speed * time / radius;
  Pose pose = Pose::Identity();
  pose.translation() =
      Vector3d(radius * std::sin(angle), radius * (1.0 - std::cos(angle)), climb * time);
  pose.linear() = rotation_from_rpy(0.0, 0.0, angle);
  return pose;
}

// Two rounds of a circle, with jumps of `noise` (m) from pose to pose.
Trajectory circle(double noise = 0.0, std::int64_t interval_ns = 100'000'000) {
  Trajectory route;
  Random random(1);
  for (std::int64_t t = 0; t <= 62'000'000'000; t += interval_ns) {
    Pose pose = pose_at(static_cast<double>(t) * 1e-9);
    for (int axis = 0; axis < 3; ++axis) pose.translation()[axis] += noise * random.gaussian();
    route.push_back({t, pose});
  }
  return route;
}

std::string error_of(const Trajectory& route) {
  return lego_loam_sc::error_of([&] { make_track(route); });
}

TEST(SimRecordedTrack, FollowsTheRouteThroughSeveralTurns) {
  const Track track = make_track(circle());
  for (double t = 1.0; t < 61.0; t += 0.37) {
    const Vector3d plan = track.plan.at(t);
    EXPECT_LT((plan.head<2>() - pose_at(t).translation().head<2>()).norm(), 0.01);
    EXPECT_NEAR(plan.z(), speed * t / radius, 1e-3);  // beyond pi without a jump
    EXPECT_NEAR(track.height.at(t), climb * t, 1e-6);
  }
}

TEST(SimRecordedTrack, SmoothsTheJumpsOfARecordingAway) {
  const double noise = 0.05;  // m; as it is, this would be jerks of 0.05 * sqrt(2) / 0.1 m/s
  const Track track = make_track(circle(noise));
  double worst = 0.0;
  for (double t = 1.0; t < 61.0; t += 0.1)
    worst = std::max(worst, std::abs(track.plan.derivative(t).head<2>().norm() - speed));
  EXPECT_LT(worst, 0.3);
  EXPECT_NEAR(path_of(track).curve.end(), 62.0 * speed, 0.001 * 62.0 * speed + 1.0);
}

TEST(SimRecordedTrack, ResamplesARouteOfAnotherRate) {
  const Track track = make_track(circle(0.0, 33'000'000));
  for (double t = 1.0; t < 61.0; t += 0.37)
    EXPECT_LT((track.plan.at(t).head<2>() - pose_at(t).translation().head<2>()).norm(), 0.01);
}

TEST(SimRecordedTrack, TheWayIsTheSameByDistance) {
  const Track track = make_track(circle());
  const TrackPath path = path_of(track);
  for (double t = 0.0; t < 60.0; t += 0.7) {
    const double travelled = path.travelled.at(t);
    EXPECT_NEAR(travelled, speed * t, 0.05);
    EXPECT_LT((path.curve.at(travelled) - track.plan.at(t).head<2>()).norm(), 0.05);
  }
}

TEST(SimRecordedTrack, GoesStraightOnBeyondItsEnds) {
  const Track track = make_track(circle());
  const double end = track.plan.end();
  const Vector3d expected = track.plan.at(end) + 0.5 * track.plan.derivative(end);
  EXPECT_LT((track.plan.at(end + 0.5) - expected).norm(), 1e-9);
  EXPECT_LT((track.plan.at(end + 1e-6) - track.plan.at(end)).norm(), 1e-4);
}

TEST(SimRecordedTrack, ReadsThePosesOfACameraAndOfALidarAlike) {
  const TemporaryFolder folder;
  Pose T_camera_lidar = Pose::Identity();
  T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  write_kitti(folder.path() / "kitti.txt", circle(), T_camera_lidar);
  write_tum(folder.path() / "route.tum", circle());
  const Trajectory kitti = read_route(folder.path() / "kitti.txt");
  const Trajectory tum = read_route(folder.path() / "route.tum");
  ASSERT_EQ(kitti.size(), circle().size());
  ASSERT_EQ(tum.size(), circle().size());
  for (std::size_t i = 0; i < kitti.size(); i += 50) {
    EXPECT_TRUE(kitti[i].pose.isApprox(circle()[i].pose, 1e-7));
    EXPECT_TRUE(tum[i].pose.isApprox(circle()[i].pose, 1e-7));
    EXPECT_EQ(kitti[i].stamp_ns, tum[i].stamp_ns);
  }
}

TEST(SimRecordedTrack, WhatNoVehicleDrivesIsAnErrorThatNamesThePlace) {
  Trajectory jump = circle();
  jump[100].pose.translation().x() += 30.0;
  EXPECT_NE(error_of(jump).find("pose 101"), std::string::npos) << error_of(jump);
  Trajectory backward = circle();
  backward[7].stamp_ns = backward[6].stamp_ns;
  EXPECT_NE(error_of(backward).find("pose 8"), std::string::npos) << error_of(backward);
  Trajectory brief = circle();
  brief.resize(5);
  EXPECT_NE(error_of(brief).find("m long"), std::string::npos) << error_of(brief);
  Trajectory single = circle();
  single.resize(1);
  EXPECT_NE(error_of(single).find("m long"), std::string::npos) << error_of(single);
  EXPECT_NE(error_of(Trajectory()).find("no poses"), std::string::npos);
  Trajectory at_rest = circle();  // 25 m of jitter
  Random random(2);
  for (StampedPose& stamped : at_rest)
    stamped.pose.translation() = Vector3d(0.04 * random.gaussian(), 0.0, 0.0);
  EXPECT_NE(error_of(at_rest).find("m long"), std::string::npos) << error_of(at_rest);
  Trajectory endless = circle();
  endless.back().stamp_ns += 100'000'000'000'000;
  EXPECT_NE(error_of(endless).find("lasts longer"), std::string::npos) << error_of(endless);
  Trajectory wide = circle();
  for (std::size_t i = 0; i < wide.size(); ++i) {
    wide[i].stamp_ns *= 100;
    wide[i].pose.translation().x() += 10.0 * static_cast<double>(i);
  }
  EXPECT_NE(error_of(wide).find("wider"), std::string::npos) << error_of(wide);
}

}  // namespace
}  // namespace lego_loam_sc
