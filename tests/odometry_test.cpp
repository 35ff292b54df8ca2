// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "made_scenes.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kNoise = 0.01;
constexpr double kSeconds = 0.1;

// ---- Searches against brute force.

FeaturePoint feature(const Vector3f& position, int row) {
  FeaturePoint point;
  point.position = position;
  point.row = static_cast<std::uint16_t>(row);
  return point;
}

// Rows of different length, one of them empty; points bunched up here and there.
std::vector<FeaturePoint> random_rows(std::mt19937& random) {
  std::uniform_real_distribution<float> turn(-M_PI, M_PI), narrow(-0.5f, 0.5f), range(1.0f, 30.0f);
  std::vector<FeaturePoint> points;
  for (int row = 0; row < 8; ++row) {
    if (row == 3) continue;
    const float bunch = turn(random);
    for (int i = 0; i < 1 + 15 * row; ++i) {
      const double azimuth = i % 3 ? bunch + narrow(random) : turn(random);
      points.push_back(
          feature(range(random) * beam(azimuth, radians(2.0 * row - 8.0)).cast<float>(), row));
    }
  }
  return points;
}

int brute_force(const std::vector<FeaturePoint>& points, const Vector3f& query, int row,
                float max_distance) {
  int best = -1;
  float best_distance = max_distance;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const float distance = (points[i].position - query).norm();
    if ((row >= 0 && points[i].row != row) || distance >= best_distance) continue;
    best = i;
    best_distance = distance;
  }
  return best;
}

TEST(FeatureIndex, FindsTheNearestPointThatBruteForceFinds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-25.0f, 25.0f);
  for (int trial = 0; trial < 20; ++trial) {
    const FeatureIndex index(random_rows(random));
    for (int k = 0; k < 200; ++k) {
      const Vector3f query(place(random), place(random), 0.1f * place(random));
      for (const float reach : {0.5f, 5.0f, 1000.0f})
        EXPECT_EQ(index.nearest(query, reach), brute_force(index.points(), query, -1, reach));
    }
  }
}

TEST(FeatureIndex, FindsTheNearestPointOfARowThatBruteForceFinds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-25.0f, 25.0f);
  std::uniform_int_distribution<int> row(-1, 9);
  for (int trial = 0; trial < 20; ++trial) {
    const FeatureIndex index(random_rows(random));
    for (int k = 0; k < 300; ++k) {
      // Every third query lies close to the line where the azimuth wraps round.
      Vector3f query(place(random), place(random), 0.1f * place(random));
      if (k % 3 == 0) query = Vector3f(-std::abs(query.x()), 0.01f * query.y(), query.z());
      const int r = row(random);
      for (const float reach : {0.5f, 5.0f, 1000.0f}) {
        const int expected = r < 0 ? -1 : brute_force(index.points(), query, r, reach);
        EXPECT_EQ(index.nearest_in_row(query, r, reach), expected);
      }
    }
  }
}

TEST(FeatureIndex, FindsThePointAtTheFarEndOfARowThatLiesOnOneSideOfTheQuery) {
  std::vector<FeaturePoint> points;
  points.push_back(feature(10.0f * beam(-0.4, 0.0).cast<float>(), 0));
  for (int i = 1; i < 100; ++i)
    points.push_back(feature(20.0f * beam(-0.4 + 0.0039 * i, 0.0).cast<float>(), 0));
  points.push_back(feature(10.0f * beam(2.0, 0.0).cast<float>(), 0));
  const FeatureIndex index(points);
  EXPECT_EQ(index.nearest_in_row(Vector3f(10, 0, 0), 0, 5.0f), 0);
}

TEST(FeatureIndex, AnEmptyIndexFindsNothing) {
  const FeatureIndex index({});
  EXPECT_EQ(index.nearest(Vector3f(1, 2, 3), 1000.0f), -1);
  EXPECT_EQ(index.nearest_in_row(Vector3f(1, 2, 3), 0, 1000.0f), -1);
}

// ---- Motion between two made scans.

Features features_at(const Scene& scene, const Pose& T_world_lidar, std::uint64_t seed,
                     double height = kMadeHeight, double noise = kNoise) {
  const SensorModel sensor = made_sensor();
  const Scan scan = take_scan(scene, sensor, T_world_lidar, {.noise = noise, .seed = seed});
  return through_stages(scan, sensor, height).features;
}

Pose motion_of(double x, double y, double z, double roll_deg, double pitch_deg, double yaw_deg) {
  Pose pose = pose_of(x, y, z);
  pose.linear() = rotation_from_rpy(radians(roll_deg), radians(pitch_deg), radians(yaw_deg));
  return pose;
}

struct Error {
  double metres, angle_deg;
};

Error error_of(const Pose& estimate, const Pose& truth) {
  const Pose off = truth.inverse() * estimate;
  return {off.translation().norm(), degrees(rotation_angle(off))};
}

const Pose start = pose_of(1.0, 0.5, kMadeHeight);

Motion estimate(const Pose& T_previous_current, const OdometrySettings& settings,
                const Pose& guess = Pose::Identity()) {
  Odometry odometry(settings, kNoise);
  odometry.set_previous(features_at(street(), start, 1));
  return odometry.estimate(features_at(street(), start * T_previous_current, 2), guess, kSeconds);
}

const std::vector<Pose>& motions() {
  static const std::vector<Pose> all{
      Pose::Identity(),
      motion_of(0.5, 0, 0, 0, 0, 0),
      motion_of(1.3, 0.02, 0.01, 0.2, -0.3, 1.0),
      motion_of(-0.6, 0.1, -0.02, 0, 0.4, -2.0),
      motion_of(0.8, 0.05, 0, 0, 0, 5.0),
      motion_of(0.2, -0.1, 0.03, -0.5, 0.2, -5.0),
  };
  return all;
}

TEST(Odometry, FindsTheMotionBetweenTwoScansOfAStreetWithoutAGuess) {
  for (const Pose& truth : motions()) {
    const Motion motion = estimate(truth, {});
    EXPECT_TRUE(motion.solved);
    EXPECT_FALSE(motion.localizability.degenerate());
    const Error error = error_of(motion.T_previous_current, truth);
    EXPECT_LT(error.metres, 0.02) << truth.translation().transpose();
    EXPECT_LT(error.angle_deg, 0.1) << truth.translation().transpose();
  }
}

TEST(Odometry, TheTwoStepsAloneFindItOnFlatGround) {
  OdometrySettings two_step;
  two_step.polish_iterations = 0;
  for (const Pose& truth : motions()) {
    const Error error = error_of(estimate(truth, two_step).T_previous_current, truth);
    EXPECT_LT(error.metres, 0.02);
    EXPECT_LT(error.angle_deg, 0.1);
  }
}

TEST(Odometry, BeforeARampTheJointSolveIsNearerThanTheTwoStepsAlone) {
  // The ground alone cannot tell moving up the ramp from moving towards it.
  Scene scene = street();
  scene.plane({6, 0, 0}, {-std::tan(radians(6.0)), 0, 1});
  const auto error_with = [&](const OdometrySettings& settings) {
    const Pose truth = motion_of(1.3, 0, 0, 0, 0, 0);
    Odometry odometry(settings, kNoise);
    odometry.set_previous(features_at(scene, start, 1));
    const Motion motion =
        odometry.estimate(features_at(scene, start * truth, 2), Pose::Identity(), kSeconds);
    EXPECT_TRUE(motion.solved);
    return error_of(motion.T_previous_current, truth);
  };
  OdometrySettings two_step;
  two_step.polish_iterations = 0;
  OdometrySettings polished;
  polished.polish_iterations = 5;
  EXPECT_LT(error_with(two_step).metres, 0.15);
  EXPECT_LT(error_with(polished).metres, 0.5 * error_with(two_step).metres);
}

TEST(Odometry, OneJointSolveFindsTheMotionToo) {
  OdometrySettings joint;
  joint.two_step = false;
  for (const Pose& truth : motions()) {
    const Motion motion = estimate(truth, joint);
    EXPECT_TRUE(motion.solved);
    const Error error = error_of(motion.T_previous_current, truth);
    EXPECT_LT(error.metres, 0.02);
    EXPECT_LT(error.angle_deg, 0.1);
  }
}

TEST(Odometry, ACorridorWithoutEndKeepsTheGuessAlongItsAxis) {
  // So little noise that no point of a wall passes for an edge.
  constexpr double kHeight = 1.2, kLittle = 0.002;
  OdometrySettings settings;
  settings.min_edges = 10;
  Odometry odometry(settings, kNoise);
  odometry.set_previous(features_at(corridor(), pose_of(0, 0, kHeight), 1, kHeight, kLittle));
  const Pose truth = motion_of(0.7, 0.1, 0, 0, 0, 1.0);
  const Pose guess = motion_of(0.9, 0, 0, 0, 0, 0);
  const Features current =
      features_at(corridor(), pose_of(0, 0, kHeight) * truth, 2, kHeight, kLittle);
  const Motion motion = odometry.estimate(current, guess, kSeconds);
  ASSERT_TRUE(motion.solved);
  ASSERT_EQ(motion.localizability.degenerate_translations, 1);
  EXPECT_GT(std::abs(motion.localizability.translation_axes(0, 0)), 0.99);
  EXPECT_NEAR(motion.T_previous_current.translation().x(), 0.9, 0.02);
  EXPECT_NEAR(motion.T_previous_current.translation().y(), 0.1, 0.03);
}

TEST(Odometry, WithTooFewPointsTheGuessComesBack) {
  Odometry odometry({}, kNoise);
  const Features full = features_at(street(), start, 1);
  const Pose guess = motion_of(0.4, 0.1, 0, 0, 0, 2.0);
  Features few;
  few.edges_sharp.assign(full.edges_sharp.begin(), full.edges_sharp.begin() + 5);
  few.planars_flat.assign(full.planars_flat.begin(), full.planars_flat.begin() + 5);
  odometry.set_previous(full);
  for (const Features& features : {few, Features{}}) {
    const Motion motion = odometry.estimate(features, guess, kSeconds);
    EXPECT_FALSE(motion.solved);
    EXPECT_TRUE(motion.T_previous_current.isApprox(guess, 0.0));
  }
  odometry.set_previous({});
  EXPECT_FALSE(odometry.estimate(full, guess, kSeconds).solved);
}

TEST(Odometry, WithoutAPreviousScanTheGuessComesBack) {
  const Odometry odometry({}, kNoise);
  EXPECT_FALSE(odometry.has_previous());
  const Pose guess = motion_of(0.4, 0.1, 0, 0, 0, 2.0);
  const Motion motion = odometry.estimate(features_at(street(), start, 1), guess, kSeconds);
  EXPECT_FALSE(motion.solved);
  EXPECT_TRUE(motion.T_previous_current.isApprox(guess, 0.0));
}

}  // namespace
}  // namespace lego_loam_sc
