// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "eval/association.hpp"
#include "eval/error_report.hpp"
#include "eval/errors.hpp"

namespace lego_loam_sc {
namespace {

using Pairs = std::vector<PosePair>;

Pose at(double x, double y, double z) {
  return Pose(Eigen::Translation3d(x, y, z));
}

const Pose kFar = Eigen::Translation3d(5e5, -4e5, 120) *
                  Pose(rotation_from_rpy(0.2, -0.3, 2.5) * Eigen::Isometry3d::Identity());

// A straight drive with steps of `step` metres; the estimate overshoots each by `factor`.
Pairs straight_drive(int steps, double step, double factor) {
  Pairs pairs;
  for (int i = 0; i <= steps; ++i)
    pairs.push_back({at(step * i, 0, 0), at(factor * step * i, 0, 0)});
  return pairs;
}

PoseFile stamped(const std::vector<std::int64_t>& stamps_ns) {
  PoseFile file;
  for (const std::int64_t stamp : stamps_ns)
    file.poses.push_back({stamp, at(static_cast<double>(stamp) * 1e-9, 0, 0)});
  return file;
}

PoseFile indexed(int count) {
  PoseFile file;
  file.has_stamps = false;
  for (int i = 0; i < count; ++i) file.poses.push_back({i, at(i, 0, 0)});
  return file;
}

TEST(Errors, AreZeroForAPerfectEstimateInAnotherMapFrame) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Pairs pairs;
  Pose truth = Pose::Identity();
  for (int i = 0; i < 50; ++i) {
    Vector6 step;
    for (double& s : step) s = 0.3 * normal(random);
    truth = normalized(truth * exp_se3(step));
    pairs.push_back({truth, kFar * truth});
  }
  EXPECT_TRUE((align(pairs) * kFar).isApprox(Pose::Identity(), 1e-8));
  const TrajectoryError error = evaluate(pairs);
  EXPECT_EQ(error.pairs, 50u);
  EXPECT_LT(error.ate.max, 1e-8);
  EXPECT_GT(error.ate_unaligned.rmse, 6e5);
  EXPECT_LT(error.rpe_frame.translation.max, 1e-8);
  EXPECT_LT(error.rpe_frame.rotation_deg.max, 1e-5);
  EXPECT_LT(error.end.translation.norm(), 1e-8);
  EXPECT_NEAR(error.estimate_length, error.truth_length, 1e-6);
}

TEST(Errors, AteIsWhatNoRigidMotionCanRemove) {
  // Corners of a square, up and down by turns: no shift and no tilt makes it better.
  const Pairs corners = {{at(1, 1, 0), kFar * at(1, 1, 0.3)},
                         {at(-1, 1, 0), kFar * at(-1, 1, -0.3)},
                         {at(-1, -1, 0), kFar * at(-1, -1, 0.3)},
                         {at(1, -1, 0), kFar * at(1, -1, -0.3)}};
  const TrajectoryError error = evaluate(corners);
  EXPECT_NEAR(error.ate.rmse, 0.3, 1e-8);
  EXPECT_NEAR(error.ate.mean, 0.3, 1e-8);
  EXPECT_NEAR(error.ate.max, 0.3, 1e-8);
}

TEST(Errors, AlignmentNeverMirrors) {
  const Pairs mirrored = {{at(1, 0, 0), at(-1, 0, 0)},
                          {at(0, 2, 0), at(0, 2, 0)},
                          {at(0, 0, 3), at(0, 0, 3)},
                          {at(0, 0, 0), at(0, 0, 0)}};
  EXPECT_NEAR(align(mirrored).linear().determinant(), 1.0, 1e-12);
  EXPECT_GT(evaluate(mirrored).ate.rmse, 0.1);
}

TEST(Errors, StatisticsOfKnownNumbers) {
  const Pairs pairs = {{at(0, 0, 0), at(0, 0, 1)},
                       {at(5, 0, 0), at(5, 0, 2)},
                       {at(5, 5, 0), at(5, 5, 3)},
                       {at(0, 5, 0), at(0, 5, 10)}};
  const Statistics s = evaluate(pairs).ate_unaligned;
  EXPECT_DOUBLE_EQ(s.mean, 4.0);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(114.0 / 4.0));
  EXPECT_DOUBLE_EQ(s.min, 1.0);
  EXPECT_DOUBLE_EQ(s.max, 10.0);
  EXPECT_DOUBLE_EQ(evaluate(Pairs(pairs.begin(), pairs.begin() + 3)).ate_unaligned.median, 2.0);
}

TEST(Errors, RpeIsTheErrorOfEachStep) {
  Vector6 step = Vector6::Zero();
  step << 0.7, 0.0, 0.1, 0.02, 0.0, 0.3;
  Pose wrong = Pose::Identity();
  wrong.linear() = rotation_from_rpy(0, 0, radians(1.5));
  wrong.translation() = Eigen::Vector3d(0.03, 0.04, 0.0);
  Pairs pairs = {{Pose::Identity(), kFar}};
  for (int i = 0; i < 20; ++i)
    pairs.push_back(
        {pairs.back().truth * exp_se3(step), pairs.back().estimate * exp_se3(step) * wrong});
  const RelativeError rpe = evaluate(pairs).rpe_frame;
  EXPECT_NEAR(rpe.translation.rmse, 0.05, 1e-8);
  EXPECT_NEAR(rpe.translation.max, 0.05, 1e-8);
  EXPECT_NEAR(rpe.rotation_deg.rmse, 1.5, 1e-6);
}

TEST(Errors, RpePerMetreCollectsTheStepsOfOneMetre) {
  const TrajectoryError error = evaluate(straight_drive(40, 0.25, 1.02));
  ASSERT_TRUE(error.rpe_metre);
  EXPECT_NEAR(error.rpe_frame.translation.rmse, 0.005, 1e-12);
  EXPECT_NEAR(error.rpe_metre->translation.rmse, 0.02, 1e-12);
  EXPECT_FALSE(evaluate(straight_drive(3, 0.25, 1.02)).rpe_metre);
}

TEST(Errors, KittiErrorOfAConstantScaleIsThatScale) {
  const TrajectoryError error = evaluate(straight_drive(2000, 1.0, 1.02));
  ASSERT_TRUE(error.kitti);
  // A segment ends at the first pose beyond its length, so here it is 1 m too long.
  EXPECT_GT(error.kitti->translation_percent, 2.0);
  EXPECT_LT(error.kitti->translation_percent, 2.0 * 101.0 / 100.0);
  EXPECT_NEAR(error.kitti->rotation_deg_per_100m, 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(error.truth_length, 2000.0);
  EXPECT_NEAR(error.estimate_length, 2040.0, 1e-9);
}

TEST(Errors, KittiErrorOfAConstantTurnIsThatTurn) {
  Pairs pairs;
  for (int i = 0; i <= 250; ++i) {
    Pose estimate = at(i, 0, 0);
    estimate.linear() = rotation_from_rpy(0, 0, radians(0.01 * i));
    pairs.push_back({at(i, 0, 0), estimate});
  }
  const TrajectoryError error = evaluate(pairs);
  ASSERT_TRUE(error.kitti);
  EXPECT_EQ(error.kitti->segments, 15u + 5u);  // of 100 m from 0 .. 140, of 200 m from 0 .. 40
  EXPECT_NEAR(error.kitti->rotation_deg_per_100m, (15 * 1.01 + 5 * 1.005) / 20, 1e-9);
}

TEST(Errors, KittiErrorNeedsAHundredMetres) {
  EXPECT_FALSE(evaluate(straight_drive(99, 1.0, 1.0)).kitti);
  EXPECT_EQ(evaluate(straight_drive(101, 1.0, 1.0)).kitti->segments, 1u);
}

TEST(Errors, EndErrorIsAlongTheAxesOfTheFirstPose) {
  // Both start facing west; the estimate ends 0.5 m ahead, 0.2 m to the left of and 3 m below the
  // truth, turned by 4 degrees.
  Pose start = at(10, 20, 0);
  start.linear() = rotation_from_rpy(0, 0, M_PI);
  Pose turned = at(30.5, 0.2, -3);
  turned.linear() = rotation_from_rpy(0, 0, radians(4));
  const TrajectoryError error =
      evaluate(Pairs{{start, kFar}, {start * at(30, 0, 0), kFar * turned}});
  EXPECT_TRUE(error.end.translation.isApprox(Eigen::Vector3d(0.5, 0.2, -3), 1e-9));
  EXPECT_NEAR(error.end.rotation_deg, 4.0, 1e-9);
  EXPECT_NEAR(error.truth_first_to_last, 30.0, 1e-9);
  EXPECT_NEAR(error.estimate_first_to_last, turned.translation().norm(), 1e-9);
}

TEST(Association, TakesTheNearestStampWithinTenMilliseconds) {
  const PoseFile truth = stamped({0, 100'000'000, 200'000'000, 300'000'000, 400'000'000});
  const PoseFile estimate = stamped({4'000'000, 89'999'999, 210'000'000, 295'000'000});
  const Pairs pairs = associate(truth, estimate);
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_DOUBLE_EQ(pairs[0].truth.translation().x(), 0.0);
  EXPECT_DOUBLE_EQ(pairs[0].estimate.translation().x(), 0.004);
  EXPECT_DOUBLE_EQ(pairs[1].truth.translation().x(), 0.2);
  EXPECT_DOUBLE_EQ(pairs[2].estimate.translation().x(), 0.295);
  // The longer one may be the estimate as well.
  const Pairs swapped = associate(estimate, truth);
  ASSERT_EQ(swapped.size(), 3u);
  EXPECT_DOUBLE_EQ(swapped[0].truth.translation().x(), 0.004);
}

TEST(Association, PairsFilesWithoutStampsByIndex) {
  EXPECT_EQ(associate(indexed(5), indexed(5)).size(), 5u);
  EXPECT_EQ(associate(indexed(5), indexed(3)).size(), 3u);  // a run that was stopped
  EXPECT_EQ(associate(indexed(3), stamped({10, 20, 30})).size(), 3u);
  EXPECT_DOUBLE_EQ(associate(indexed(5), indexed(3))[2].truth.translation().x(), 2.0);
}

TEST(Association, RefusesWhatDoesNotBelongTogether) {
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();
  EXPECT_THROW(associate(indexed(3), indexed(5)), InputError);
  EXPECT_THROW(associate(indexed(5), stamped({10, 20, 30})), InputError);
  EXPECT_THROW(associate(indexed(1), indexed(1)), InputError);
  EXPECT_THROW(associate(indexed(0), stamped({})), InputError);
  EXPECT_THROW(associate(stamped({}), stamped({1, 2})), InputError);
  EXPECT_THROW(associate(stamped({1, 3, 2}), stamped({1, 2, 3})), InputError);
  EXPECT_THROW(associate(stamped({1, 2, 3}), stamped({1, 2, 2})), InputError);
  EXPECT_THROW(associate(stamped({kFirst, kFirst + 1}), stamped({kLast - 1, kLast})), InputError);
}

TEST(ErrorReport, SaysWhatThePathIsTooShortFor) {
  const TrajectoryError short_error = evaluate(straight_drive(3, 0.25, 1.0));
  EXPECT_TRUE(to_json(short_error)["kitti"].is_null());
  EXPECT_TRUE(to_json(short_error)["rpe_metre"].is_null());
  const TrajectoryError long_error = evaluate(straight_drive(300, 1.0, 1.5));
  EXPECT_DOUBLE_EQ(to_json(long_error)["kitti"]["t_rel_percent"].get<double>(),
                   long_error.kitti->translation_percent);

  const std::vector<NamedError> estimates = {{"a.tum", short_error}, {"b.tum", long_error}};
  const std::string table = error_table(estimates);
  EXPECT_NE(table.find("a.tum"), std::string::npos);
  const std::size_t kitti = table.find("KITTI t_rel (%)");
  ASSERT_NE(kitti, std::string::npos);
  EXPECT_NE(table.find("path too short", kitti), std::string::npos);
  const std::size_t length = table.find("length of the estimate (m)");
  EXPECT_NE(table.substr(length, table.find('\n', length) - length).find("450.000"),
            std::string::npos);
}

}  // namespace
}  // namespace lego_loam_sc
