// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mapper.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "made_scenes.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kNoise = 0.01;

Features features_at(const Scene& scene, const Pose& T_world_lidar, std::uint64_t seed,
                     double height) {
  const SensorModel sensor = made_sensor(900);
  const Scan scan = take_scan(scene, sensor, T_world_lidar, {.noise = kNoise, .seed = seed});
  return through_stages(scan, sensor, height).features;
}

// A map of a few scans along x, in world coordinates.
Mapper mapped(const Scene& scene, double height, const MappingSettings& settings = {}) {
  Mapper mapper(settings, kNoise);
  for (int k = 0; k < 4; ++k) {
    const Pose at = pose_of(0.7 * k - 3.0, 4.0, height, 3.0 * k);
    mapper.insert(features_at(scene, at, static_cast<std::uint64_t>(k + 1), height), at);
  }
  return mapper;
}

Pose off_by(const Pose& pose, double x, double y, double z, double yaw_deg) {
  return pose * pose_of(x, y, z, yaw_deg);
}

TEST(Mapper, FindsThePoseFromAGuessThatIsOffByThirtyCentimetresAndThreeDegrees) {
  Mapper mapper = mapped(hall(), kMadeHeight);
  const Pose truth = pose_of(-1.2, 4.3, kMadeHeight, 12.0);
  const Features features = features_at(hall(), truth, 50, kMadeHeight);
  for (const double sign : {-1.0, 1.0}) {
    for (const Pose& guess :
         {off_by(truth, 0.3 * sign, 0, 0, 3.0), off_by(truth, 0, 0.3 * sign, 0.05, -3.0),
          off_by(truth, 0.2, 0.2 * sign, -0.05, 2.0)}) {
      const MapMatch match = mapper.refine(features, {guess, guess, Pose::Identity(), 0.1});
      ASSERT_TRUE(match.matched);
      const Pose error = truth.inverse() * match.T_map_lidar;
      EXPECT_LT(error.translation().norm(), 0.02);
      EXPECT_LT(degrees(rotation_angle(error)), 0.1);
      EXPECT_FALSE(match.localizability.degenerate());
      EXPECT_LT(match.rmse, 0.05);
      EXPECT_GT(match.matches, match.points / 2);
    }
  }
}

// The scans that made the map had edges enough, this one has not: nothing in the map is like its
// scattered points, of which there are many.
TEST(Mapper, ScatteredPointsThatTheMapDoesNotHaveDoNoHarm) {
  Mapper mapper = mapped(hall(), kMadeHeight);
  const Pose truth = pose_of(-1.2, 4.3, kMadeHeight, 12.0);
  Features features = features_at(hall(), truth, 50, kMadeHeight);
  for (int k = 0; k < 20000; ++k) {
    FeaturePoint p;
    p.position =
        Eigen::Vector3f(static_cast<float>(k % 100) - 50.0f,
                        static_cast<float>(k / 100 % 100) - 50.0f, static_cast<float>(k / 10000));
    features.scattered.push_back(p);
  }
  const Pose guess = off_by(truth, 0.1, 0.0, 0.0, 1.0);
  const MapMatch match = mapper.refine(features, {guess, guess, Pose::Identity(), 0.1});
  ASSERT_TRUE(match.matched);
  EXPECT_LT((truth.inverse() * match.T_map_lidar).translation().norm(), 0.02);
}

TEST(Mapper, TheCovarianceIsPositiveDefiniteAndSpeaksOfCentimetresAtMost) {
  Mapper mapper = mapped(hall(), kMadeHeight);
  const Pose truth = pose_of(-1.2, 4.3, kMadeHeight, 12.0);
  const MapMatch match = mapper.refine(features_at(hall(), truth, 51, kMadeHeight),
                                       {truth, truth, Pose::Identity(), 0.1});
  ASSERT_TRUE(match.matched);
  EXPECT_LT((match.covariance - match.covariance.transpose()).norm(), 1e-12);
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(match.covariance);
  EXPECT_GT(eigen.eigenvalues()[0], 0.0);
  EXPECT_LT(eigen.eigenvalues()[5], 0.01 * 0.01);
}

TEST(Mapper, DeskewsASweepWithTheMotionSinceThePreviousScan) {
  Mapper mapper = mapped(hall(), kMadeHeight);
  Vector6 twist;
  twist << 5.0, 0.0, 0.0, 0.0, 0.0, 0.6;
  const Pose start = pose_of(-2.0, 4.0, kMadeHeight, 5.0);
  const SensorModel sensor = made_sensor(900);
  const Scan sweep =
      take_sweep(hall(), sensor, [&](double seconds) { return start * exp_se3(twist * seconds); },
                 {.noise = kNoise, .seed = 9});
  const Features features = through_stages(sweep, sensor, kMadeHeight).features;
  const Pose truth = start * exp_se3(0.05 * twist);
  const Pose motion = exp_se3(0.1 * twist);
  const MapMatch match = mapper.refine(
      features, {off_by(truth, 0.1, 0.05, 0, 1.0), off_by(truth, 0.1, 0.05, 0, 1.0), motion, 0.1});
  ASSERT_TRUE(match.matched);
  const Pose error = truth.inverse() * match.T_map_lidar;
  EXPECT_LT(error.translation().norm(), 0.03);
  EXPECT_LT(degrees(rotation_angle(error)), 0.2);
}

TEST(Mapper, FindsTheVelocityOfASweepThatTheMotionBeforeDidNotHave) {
  Mapper mapper = mapped(hall(), kMadeHeight);
  Vector6 twist;
  twist << 1.2, 0.0, 0.0, 0.0, 0.1, 0.2;
  const Pose start = pose_of(-2.0, 4.0, kMadeHeight, 5.0);
  const Scan sweep = take_sweep(hall(), made_sensor(900),
                                [&](double seconds) { return start * exp_se3(twist * seconds); },
                                {.noise = kNoise, .seed = 10});
  const Features features = through_stages(sweep, made_sensor(900), kMadeHeight).features;
  const Pose truth = start * exp_se3(0.05 * twist);
  const Pose half = exp_se3(0.05 * twist);  // it was half as fast before
  const MapMatch match = mapper.refine(features, {truth, truth, half, 0.1});
  ASSERT_TRUE(match.matched);
  EXPECT_LT((match.twist - twist).head<3>().norm(), 0.15);
  EXPECT_LT((match.twist - twist).tail<3>().norm(), radians(1.0));
}

TEST(Mapper, StandingStillAddsNothing) {
  MappingSettings settings;
  settings.match_points = 0;  // the same ones each time
  Mapper mapper(settings, kNoise);
  const Pose at = pose_of(0, 4, kMadeHeight), near = pose_of(0.02, 4, kMadeHeight);
  const Features features = features_at(hall(), at, 60, kMadeHeight);
  mapper.add_scan(features, at);
  const MapMatch once = mapper.refine(features, {at, at, Pose::Identity(), 0.1});
  for (int k = 0; k < 5; ++k) mapper.add_scan(features, near);
  EXPECT_EQ(mapper.refine(features, {at, at, Pose::Identity(), 0.1}).rmse, once.rmse);
  mapper.clear();
  mapper.add_scan(features, near);
  EXPECT_FALSE(mapper.empty());
}

TEST(Mapper, DoesNotMatchWhenTheMapIsElsewhere) {
  Mapper mapper = mapped(hall(), kMadeHeight);
  const Features features = features_at(hall(), pose_of(0, 4, kMadeHeight), 52, kMadeHeight);
  const Pose guess = pose_of(300, -200, kMadeHeight, 30.0);
  const MapMatch match = mapper.refine(features, {guess, guess, Pose::Identity(), 0.1});
  EXPECT_FALSE(match.matched);
  EXPECT_EQ(match.T_map_lidar.matrix(), guess.matrix());
}

TEST(Mapper, TakesAboutAsManyPointsAsItShould) {
  MappingSettings settings;
  settings.match_points = 2000;
  settings.scattered_points = 0;
  Mapper mapper = mapped(hall(), kMadeHeight, settings);
  const Pose at = pose_of(0, 4, kMadeHeight);
  const Features features = features_at(hall(), at, 61, kMadeHeight);
  int points = 0;
  for (int k = 0; k < 8; ++k)
    points = mapper.refine(features, {at, at, Pose::Identity(), 0.1}).points;
  EXPECT_NEAR(points, 2000, 200);
}

TEST(Mapper, DoesNotMatchNothing) {
  Mapper mapper = mapped(hall(), kMadeHeight);
  EXPECT_FALSE(
      mapper.refine({}, {Pose::Identity(), Pose::Identity(), Pose::Identity(), 0.1}).matched);
  mapper.clear();
  EXPECT_TRUE(mapper.empty());
  const Features features = features_at(hall(), pose_of(0, 4, kMadeHeight), 53, kMadeHeight);
  EXPECT_FALSE(mapper
                   .refine(features, {pose_of(0, 4, kMadeHeight), pose_of(0, 4, kMadeHeight),
                                      Pose::Identity(), 0.1})
                   .matched);
}

TEST(Mapper, ATunnelWithoutEndKeepsTheGuessAlongItsAxis) {
  constexpr double kHeight = 1.2;
  Mapper mapper({}, kNoise);
  for (int k = 0; k < 4; ++k) {
    const Pose at = pose_of(0.5 * k, 0, kHeight);
    mapper.insert(features_at(corridor(), at, static_cast<std::uint64_t>(k + 1), kHeight), at);
  }
  const Pose truth = pose_of(2.0, 0.1, kHeight, 1.0);
  const Pose guess = pose_of(2.4, 0.0, kHeight, 0.0);
  const MapMatch match = mapper.refine(features_at(corridor(), truth, 54, kHeight),
                                       {guess, guess, Pose::Identity(), 0.1});
  ASSERT_TRUE(match.matched);
  ASSERT_EQ(match.localizability.degenerate_translations, 1);
  EXPECT_GT(std::abs(match.localizability.translation_axes(0, 0)), 0.99);
  EXPECT_EQ(match.localizability.degenerate_rotations, 0);
  EXPECT_NEAR(match.T_map_lidar.translation().x(), 2.4, 0.02);
  EXPECT_NEAR(match.T_map_lidar.translation().y(), 0.1, 0.02);
  EXPECT_NEAR(match.T_map_lidar.translation().z(), kHeight, 0.02);
  EXPECT_NEAR(degrees(rpy_from_rotation(match.T_map_lidar.linear()).z()), 1.0, 0.1);
}

TEST(Mapper, ForgetsWhatItHasLeftBehind) {
  MappingSettings settings;
  settings.radius = 40.0;
  Mapper mapper = mapped(hall(), kMadeHeight, settings);
  const Pose here = pose_of(-2.0, 4.0, kMadeHeight);
  const Features features = features_at(hall(), here, 55, kMadeHeight);
  EXPECT_TRUE(mapper.refine(features, {here, here, Pose::Identity(), 0.1}).matched);
  const Pose far = pose_of(300, 0, kMadeHeight);
  mapper.add_scan(features, far);
  EXPECT_FALSE(mapper.refine(features, {here, here, Pose::Identity(), 0.1}).matched);
  EXPECT_TRUE(mapper.refine(features, {far, far, Pose::Identity(), 0.1}).matched);
}

}  // namespace
}  // namespace lego_loam_sc
