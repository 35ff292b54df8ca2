// SPDX-License-Identifier: BSD-3-Clause
#include "registration/deskew.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "key_frames/make_key_frame.hpp"
#include "made_scenes.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

TEST(Deskew, TheSweepMotionIsTheExactMotion) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    Vector6 twist;
    for (int i = 0; i < 6; ++i) twist[i] = (i < 3 ? 20.0 : 1.5) * one(random);
    const SweepMotion motion(twist, 0.05f);
    for (int k = 0; k < 20; ++k) {
      const Vector3d point(30.0 * one(random), 30.0 * one(random), 5.0 * one(random));
      const auto time = static_cast<float>(0.05 * one(random));
      const Vector3d exact = exp_se3(twist * static_cast<double>(time)) * point;
      EXPECT_LT((motion(point.cast<float>(), time).cast<double>() - exact).norm(), 1e-4);
    }
  }
}

TEST(Deskew, TheEndsOfASweepAreExactToo) {
  Vector6 twist;
  twist << 10.0, 1.0, 0.0, 0.1, 0.2, 1.0;
  const SweepMotion motion(twist, 0.05f);
  for (const float time : {-0.05f, 0.0f, 0.05f}) {
    const Vector3d exact = exp_se3(twist * static_cast<double>(time)) * Vector3d(20.0, 5.0, 1.0);
    EXPECT_LT((motion(Vector3f(20, 5, 1), time).cast<double>() - exact).norm(), 1e-5);
  }
}

FeaturePoint point_at_time(const Vector3f& position, float time) {
  FeaturePoint point;
  point.position = position;
  point.time = time;
  point.intensity = 7.0f;
  point.row = 3;
  return point;
}

TEST(Deskew, PointsWithoutTimesStayWhereTheyAre) {
  const std::vector<FeaturePoint> points{point_at_time({1, 2, 3}, 0.0f)};
  EXPECT_EQ(deskew(points, Vector6::Constant(3.0))[0].position, points[0].position);
  EXPECT_TRUE(deskew(std::vector<FeaturePoint>{}, Vector6::Constant(3.0)).empty());
}

TEST(Deskew, ADeskewedPointHasMovedAndKeepsTheRest) {
  const std::vector<FeaturePoint> points{point_at_time({1, 2, 3}, 0.02f),
                                         point_at_time({4, 5, 6}, -0.03f)};
  EXPECT_FLOAT_EQ(max_abs_time(points), 0.03f);
  const std::vector<FeaturePoint> moved = deskew(points, 2.0 * Vector6::Unit(0));
  EXPECT_NEAR(moved[0].position.x(), 1.04, 1e-5);
  EXPECT_NEAR(moved[1].position.x(), 3.94, 1e-5);
  EXPECT_EQ(moved[0].time, 0.02f);
  for (const FeaturePoint& p : moved) {
    EXPECT_EQ(p.intensity, 7.0f);
    EXPECT_EQ(p.row, 3);
  }
}

TEST(Deskew, ASweepOfAMovingSensorBecomesStraightAgain) {
  const Vector3d low(-8.0, -6.0, 0.0), high(9.0, 7.0, 4.0);
  Scene room;
  room.box(low, high);
  const auto off_the_wall = [&](const Vector3d& p) {
    return std::min((p - low).cwiseAbs().minCoeff(), (p - high).cwiseAbs().minCoeff());
  };
  Vector6 twist;
  twist << 6.0, 0.5, -0.2, 0.1, -0.15, 1.2;
  const Pose start = pose_of(1.0, -2.0, 1.6, 40.0);
  const SensorModel sensor = made_sensor();
  const Scan scan =
      take_sweep(room, sensor, [&](double seconds) { return start * exp_se3(twist * seconds); });
  const RangeImage image = project(scan, sensor);
  const Pose T_world_reference =
      start * exp_se3(twist * 1e-9 * static_cast<double>(image.reference_ns - scan.stamp_ns));
  const std::vector<Vector3f> straight = deskewed_points(image, twist);
  ASSERT_EQ(straight.size(), image.size());
  ASSERT_GT(straight.size(), 20'000u);
  double distorted = 0.0;
  for (std::size_t i = 0; i < straight.size(); ++i) {
    EXPECT_LT(off_the_wall(T_world_reference * straight[i].cast<double>()), 1e-4);
    distorted =
        std::max(distorted, off_the_wall(T_world_reference * image.points[i].cast<double>()));
  }
  EXPECT_GT(distorted, 0.3);
}

}  // namespace
}  // namespace lego_loam_sc
