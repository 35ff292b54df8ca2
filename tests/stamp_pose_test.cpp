// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/stamp_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lego_loam_sc {
namespace {

constexpr double kPeriod = 0.1;

// A shaking drive: the pose and, by central differences, its twist in own axes.
Pose drive(double t) {
  Pose pose = Pose::Identity();
  pose.translation() << 3.0 * t, 0.2 * t * t, 0.01 * std::sin(12.0 * t);
  pose.linear() = rotation_from_rpy(0.02 * std::sin(14.0 * t), 0.01 * std::cos(10.0 * t), 0.3 * t);
  return pose;
}

Vector6 twist(double t) {
  constexpr double kStep = 1e-5;
  return log_se3(drive(t - kStep).inverse() * drive(t + kStep)) / (2.0 * kStep);
}

double error(const Pose& estimate, const Pose& truth) {
  const Pose off = truth.inverse() * estimate;
  return off.translation().norm() + rotation_angle(off);
}

TEST(StampPose, BetweenTwoScansTheCubicIsTenTimesBetterThanConstantVelocity) {
  for (double t = 0.0; t < 3.0; t += 0.17) {
    const Pose truth = drive(t).inverse() * drive(t - 0.5 * kPeriod);
    const Pose between = interpolate(drive(t - kPeriod).inverse() * drive(t), twist(t - kPeriod),
                                     twist(t), kPeriod, -0.5 * kPeriod);
    const double cubic = error(between, truth);
    EXPECT_LT(cubic, 1e-3);
    EXPECT_LT(cubic, 0.1 * error(extrapolate(twist(t), -0.5 * kPeriod), truth) + 1e-4);
  }
}

TEST(StampPose, TheCubicMeetsBothScans) {
  const Pose motion = drive(0.9).inverse() * drive(1.0);
  const auto at = [&](double age) {
    return interpolate(motion, twist(0.9), twist(1.0), kPeriod, age);
  };
  EXPECT_LT(error(at(0.0), Pose::Identity()), 1e-12);
  EXPECT_LT(error(at(-1e-9), Pose::Identity()), 1e-7);
  EXPECT_LT(error(at(1e-9 - kPeriod), motion.inverse()), 1e-7);
}

TEST(StampPose, OutsideOfBothItGoesOnAtConstantVelocity) {
  const Pose motion = drive(0.9).inverse() * drive(1.0);
  for (const double age : {0.03, -0.3})
    EXPECT_LT(error(interpolate(motion, twist(0.9), twist(1.0), kPeriod, age),
                    extrapolate(twist(1.0), age)),
              1e-12);
}

}  // namespace
}  // namespace lego_loam_sc
