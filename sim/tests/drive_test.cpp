// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::int64_t millisecond = 1'000'000;

double flat(double, double) {
  return 0.0;
}

std::vector<Vector2d> square() {
  return {{10, 0}, {40, 0}, {40, 30}, {0, 30}, {0, 0}, {10, 0}};
}

double path_length(const Drive& drive) {
  double length = 0.0;
  for (std::int64_t t = 0; t < drive.duration_ns(); t += 10 * millisecond)
    length += (drive.pose(t + 10 * millisecond).translation() - drive.pose(t).translation()).norm();
  return length;
}

TEST(SimDrive, AStraightDriveHasTheLengthOfItsWay) {
  const Drive drive(Route({{0, 0}, {30, 40}}, 4.0), flat, {});
  EXPECT_NEAR(path_length(drive), 50.0, 1e-6);
  EXPECT_NEAR(drive.pose(0).translation().norm(), 0.0, 1e-12);
  EXPECT_NEAR((drive.pose(drive.duration_ns()).translation() - Vector3d(30, 40, 0)).norm(), 0.0,
              1e-9);
}

TEST(SimDrive, ARoundedCornerIsAsLongAsItsArc) {
  const Drive drive(Route({{0, 0}, {30, 0}, {30, 30}}, 5.0), flat, {});
  const double expected = 2.0 * (30.0 - 5.0) + 0.5 * std::numbers::pi * 5.0;
  EXPECT_NEAR(path_length(drive), expected, 0.01);
}

TEST(SimDrive, AClosedRouteEndsExactlyWhereItStarts) {
  DriveSettings settings;
  settings.shaking = {.roll_deg = 1.0, .pitch_deg = 1.0, .yaw_deg = 1.0, .z = 0.02};
  const Drive drive(Route(square(), 4.0), flat, settings);
  const Pose change = drive.pose(0).inverse() * drive.pose(drive.duration_ns());
  EXPECT_LT(change.translation().norm(), 1e-9);
  EXPECT_LT(rotation_angle(change), 1e-9);
}

TEST(SimDrive, VelocitiesAreContinuousAndStartAndEndAtRest) {
  DriveSettings settings;
  settings.shaking = {.roll_deg = 0.5, .pitch_deg = 0.5, .yaw_deg = 0.5, .z = 0.01};
  const auto hills = [](double x, double y) { return 0.5 * std::sin(x / 9.0) + 0.2 * std::cos(y); };
  const Drive drive(Route(square(), 4.0), hills, settings);
  Vector6 previous = Vector6::Zero();
  for (std::int64_t t = -millisecond; t <= drive.duration_ns() + millisecond; t += millisecond) {
    const Vector6 velocity = log_se3(drive.pose(t).inverse() * drive.pose(t + millisecond)) / 1e-3;
    EXPECT_LT((velocity - previous).norm(), 0.02) << "at " << t;
    previous = velocity;
  }
  EXPECT_LT(previous.norm(), 1e-6);
}

TEST(SimDrive, SpeedKeepsToItsLimitsAndSlowsInBends) {
  DriveSettings settings;
  settings.speed = 3.0;
  settings.acceleration = 1.0;
  settings.lateral_acceleration = 0.5;
  const Drive drive(Route(square(), 4.0), flat, settings);
  double fastest = 0.0;
  for (std::int64_t t = 0; t < drive.duration_ns(); t += 10 * millisecond) {
    const Vector6 motion =
        log_se3(drive.pose(t).inverse() * drive.pose(t + 10 * millisecond)) / 0.01;
    fastest = std::max(fastest, motion.head<3>().norm());
    EXPECT_LT(motion.head<3>().norm() * std::abs(motion[5]), 0.55);
  }
  EXPECT_NEAR(fastest, 3.0, 0.01);
}

TEST(SimDrive, TheVehicleLooksAlongItsWay) {
  const Drive drive(Route(square(), 4.0), flat, {});
  for (std::int64_t t = 1000 * millisecond; t < drive.duration_ns() - 1000 * millisecond;
       t += 97 * millisecond) {
    const Vector3d step = drive.pose(t).inverse() * drive.pose(t + millisecond).translation();
    EXPECT_NEAR(step.normalized().x(), 1.0, 1e-5);
  }
}

TEST(SimDrive, TheVehicleStandsOnTheGround) {
  const double slope_x = 0.05, slope_y = -0.03;
  const Drive drive(Route(square(), 4.0),
                    [&](double x, double y) { return slope_x * x + slope_y * y; }, {});
  const Vector3d normal = Vector3d(-slope_x, -slope_y, 1.0).normalized();
  for (std::int64_t t = 0; t < drive.duration_ns(); t += 500 * millisecond) {
    const Pose pose = drive.pose(t);
    const Vector3d p = pose.translation();
    EXPECT_NEAR(p.z(), slope_x * p.x() + slope_y * p.y(), 1e-9);
    // The attitude is that of the wheels' contact up to the product of two small angles.
    EXPECT_LT((pose.linear().col(2) - normal).norm(), 2e-3);
  }
}

TEST(SimDrive, AWayThatPassesOverItselfHasTheGroundOfEachPart) {
  // Up a slope that ends at x = 20, round, and across it on the level.
  const auto slope = [](double x, double) {
    return x < 20.0 ? 3.0 - 0.0075 * (20 - x) * (20 - x) : 3.0;
  };
  const auto level = [](double, double) { return 3.0; };
  const Route route({{0, 0}, {30, 0}, {30, 20}, {10, 20}, {10, -20}}, 3.0);
  const Drive drive(route, std::vector<GroundSection>{{0.0, slope}, {24.0, level}}, {});
  std::vector<double> heights;  // over the crossing
  for (std::int64_t t = 0; t < drive.duration_ns(); t += 10 * millisecond) {
    const Vector3d place = drive.pose(t).translation();
    if ((place.head<2>() - Vector2d(10, 0)).norm() < 0.02) heights.push_back(place.z());
  }
  ASSERT_GE(heights.size(), 2u);
  EXPECT_NEAR(heights.front(), 2.25, 0.01);
  EXPECT_NEAR(heights.back(), 3.0, 1e-9);
}

TEST(SimDrive, ShakingHasTheAskedForStrength) {
  DriveSettings settings;
  settings.shaking = {.roll_deg = 1.0, .pitch_deg = 0.5, .yaw_deg = 0.2, .z = 0.01};
  const Drive drive(Route({{0, 0}, {300, 0}}, 4.0), flat, settings);
  Eigen::Vector4d squares = Eigen::Vector4d::Zero();
  int samples = 0;
  for (std::int64_t t = 5000 * millisecond; t < drive.duration_ns() - 5000 * millisecond;
       t += 13 * millisecond, ++samples) {
    const Pose pose = drive.pose(t);
    const Vector3d rpy = rpy_from_rotation(pose.linear());
    squares += Eigen::Vector4d(rpy.x(), rpy.y(), rpy.z(), pose.translation().z()).cwiseAbs2();
  }
  const Eigen::Vector4d rms = (squares / samples).cwiseSqrt();
  EXPECT_NEAR(degrees(rms[0]), 1.0, 0.1);
  EXPECT_NEAR(degrees(rms[1]), 0.5, 0.05);
  EXPECT_NEAR(degrees(rms[2]), 0.2, 0.02);
  EXPECT_NEAR(rms[3], 0.01, 0.001);
}

TEST(SimDrive, CurvatureOfARouteIsThatOfItsArcs) {
  const Route route({{0, 0}, {30, 0}, {30, 30}}, 6.0);
  double sharpest = 0.0;
  for (double s = 0.0; s <= route.length(); s += 0.1)
    sharpest = std::max(sharpest, std::abs(route.at(s).curvature));
  EXPECT_NEAR(sharpest, 1.0 / 6.0, 0.002);
  EXPECT_NEAR(route.at(10.0).curvature, 0.0, 1e-9);
}

TEST(SimDrive, ACornerWithoutRoomForItsRadiusIsSharper) {
  const Route route({{0, 0}, {4, 0}, {4, 4}, {30, 4}}, 50.0);
  const Vector2d end = route.at(route.length()).position;
  EXPECT_LT((end - Vector2d(30, 4)).norm(), 1e-9);
  EXPECT_LT(route.length(), 4.0 + 4.0 + 26.0);
}

}  // namespace
}  // namespace lego_loam_sc
