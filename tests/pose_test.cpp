// SPDX-License-Identifier: BSD-3-Clause
#include "core/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

class Draw {
 public:
  Vector3d vector(double reach) {
    std::uniform_real_distribution<double> one(-reach, reach);
    return {one(random_), one(random_), one(random_)};
  }
  Vector3d unit() { return (vector(1.0) + Vector3d(2.0, 0.0, 0.0)).normalized(); }

 private:
  std::mt19937 random_{1};
};

constexpr double kAngles[] = {0.0, 1e-12, 1e-9, 1e-7, 9e-6, 1.1e-5, 1e-3, 0.5, 2.0, 3.0};

TEST(Pose, SkewIsTheCrossProduct) {
  Draw draw;
  const Vector3d a = draw.vector(3.0), b = draw.vector(3.0);
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST(Pose, ExpGivesTheRotationAboutTheAxisByTheAngle) {
  Draw draw;
  for (const double angle : kAngles) {
    const Vector3d axis = draw.unit();
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_LT((exp_so3(angle * axis) - expected).norm(), 1e-14) << angle;
  }
}

TEST(Pose, LogUndoesExpNearZeroAndNearPi) {
  Draw draw;
  for (const double angle : kAngles) {
    for (const double a : {angle, M_PI - angle}) {
      const Vector3d rotation = a * draw.unit();
      const Vector3d back = log_so3(exp_so3(rotation));
      // At pi the axis may turn round.
      const double error = a > M_PI - 1e-8
                               ? std::min((back - rotation).norm(), (back + rotation).norm())
                               : (back - rotation).norm();
      EXPECT_LT(error, 1e-7 * a + 1e-15) << a;
    }
  }
}

TEST(Pose, LogOfARotationIsAtMostPiLong) {
  const Vector3d axis = Vector3d(1.0, -2.0, 0.5).normalized();
  EXPECT_LT((log_so3(exp_so3(4.0 * axis)) + (2.0 * M_PI - 4.0) * axis).norm(), 1e-12);
}

TEST(Pose, TheMotionOfATwistIsTheLimitOfManySmallSteps) {
  Draw draw;
  for (int trial = 0; trial < 5; ++trial) {
    Vector6 twist;
    twist << draw.vector(5.0), draw.vector(1.5);
    constexpr int kSteps = 1 << 20;
    Pose power = Pose::Identity();
    power.linear() = exp_so3(twist.tail<3>() / kSteps);
    power.translation() = twist.head<3>() / kSteps;
    for (int squared = kSteps; squared > 1; squared /= 2) power = power * power;
    EXPECT_LT((exp_se3(twist).matrix() - power.matrix()).norm(), 1e-4);
  }
}

TEST(Pose, LogUndoesExpOfAMotion) {
  Draw draw;
  for (const double angle : kAngles) {
    Vector6 twist;
    twist << draw.vector(30.0), angle * draw.unit();
    EXPECT_LT((log_se3(exp_se3(twist)) - twist).norm(), 1e-9) << angle;
    const Pose pose = exp_se3(twist);
    EXPECT_LT((exp_se3(log_se3(pose)).matrix() - pose.matrix()).norm(), 1e-9) << angle;
  }
}

TEST(Pose, AnInverseMotionHasTheOppositeTwist) {
  Vector6 twist;
  twist << 1.0, -2.0, 3.0, 0.4, 0.5, -0.6;
  EXPECT_LT((log_se3(exp_se3(twist).inverse()) + twist).norm(), 1e-12);
}

TEST(Pose, RotationAngleIsThatOfTheRotation) {
  for (const double angle : {0.0, 1e-6, 1.0, M_PI}) {
    Vector6 twist;
    twist << 4.0, 5.0, 6.0, angle * Vector3d(2.0, -1.0, 2.0) / 3.0;
    EXPECT_NEAR(rotation_angle(exp_se3(twist)), angle, 1e-9);
  }
}

TEST(Pose, PerturbTurnsTheRotationFromTheLeftAndShiftsTheTranslation) {
  const Pose pose = exp_se3((Vector6() << 1.0, 2.0, 3.0, 0.3, -0.2, 0.9).finished());
  Vector6 delta;
  delta << 0.1, 0.2, -0.3, 0.01, 0.02, 0.03;
  const Pose moved = perturb(pose, delta);
  EXPECT_LT((moved.translation() - pose.translation() - delta.head<3>()).norm(), 1e-15);
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(delta.tail<3>().norm(), delta.tail<3>().normalized()) * pose.linear();
  EXPECT_LT((moved.linear() - turned).norm(), 1e-14);
  EXPECT_LT((perturbation_between(pose, moved) - delta).norm(), 1e-14);
}

TEST(Pose, NormalizedTakesOutTheErrorsOfManyProducts) {
  Pose pose = exp_se3((Vector6() << 1.0, 2.0, 3.0, 0.3, -0.2, 0.9).finished());
  const Pose exact = pose;
  pose.linear() *= 1.001;
  pose.linear()(0, 1) += 1e-4;
  const Pose result = normalized(pose);
  EXPECT_LT((result.linear().transpose() * result.linear() - Eigen::Matrix3d::Identity()).norm(),
            1e-14);
  EXPECT_LT((result.linear() - exact.linear()).norm(), 1e-3);
  EXPECT_EQ(result.translation(), exact.translation());
}

TEST(Pose, RollPitchAndYawComeBack) {
  for (double yaw = -3.1; yaw < 3.2; yaw += 0.62) {
    for (double pitch = -1.5; pitch < 1.6; pitch += 0.5) {
      const Vector3d rpy = rpy_from_rotation(rotation_from_rpy(0.7, pitch, yaw));
      EXPECT_LT((rpy - Vector3d(0.7, pitch, yaw)).norm(), 1e-12);
    }
  }
}

TEST(Pose, AtAPitchOfNinetyDegreesTheAnglesAreFinite) {
  const Eigen::Matrix3d R = rotation_from_rpy(0.4, M_PI / 2.0, -0.3);
  const Vector3d rpy = rpy_from_rotation(R);
  EXPECT_TRUE(rpy.allFinite());
  EXPECT_NEAR(rpy.y(), M_PI / 2.0, 1e-7);
}

TEST(Pose, PositiveYawTurnsLeftPositivePitchLooksDownPositiveRollLowersTheRight) {
  const auto turned = [](double roll, double pitch, double yaw, const Vector3d& v) -> Vector3d {
    return rotation_from_rpy(roll, pitch, yaw) * v;
  };
  EXPECT_GT(turned(0, 0, 0.1, Vector3d::UnitX()).y(), 0.0);
  EXPECT_LT(turned(0, 0.1, 0, Vector3d::UnitX()).z(), 0.0);
  EXPECT_LT(turned(0.1, 0, 0, -Vector3d::UnitY()).z(), 0.0);
}

}  // namespace
}  // namespace lego_loam_sc
