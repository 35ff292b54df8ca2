// SPDX-License-Identifier: BSD-3-Clause
#include "loop/loop_verifier.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>
#include <vector>

#include "key_frames/make_key_frame.hpp"
#include "loop/loop_closer.hpp"
#include "loop/scan_context.hpp"
#include "made_scenes.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kNoise = 0.01;

struct Visit {
  Pose T_world_lidar;
  KeyFrame key_frame;
  ScanContext context;
};

Visit visit(const Scene& scene, const Pose& T_world_lidar, std::uint64_t seed) {
  const SensorModel sensor = made_sensor(900);
  const Scan scan = take_scan(scene, sensor, T_world_lidar, {.noise = kNoise, .seed = seed});
  const Staged s = through_stages(scan, sensor, kMadeHeight);
  return {T_world_lidar,
          make_key_frame(s.image, s.segmentation, s.features, s.image.points, 0.0, 0.3),
          make_scan_context(s.image.points, kMadeHeight, {})};
}

// Along an arc through the hall, turning by 20 degrees from one to the next.
std::vector<Visit> visits_of_hall() {
  std::vector<Visit> visits;
  for (int k = -3; k <= 3; ++k)
    visits.push_back(visit(hall(),
                           pose_of(-8.0 + 0.9 * k, 5.0 + 0.1 * k * k, kMadeHeight, 20.0 * k),
                           static_cast<std::uint64_t>(k + 10)));
  return visits;
}

// In the frame of `center`, from poses in a map as the pose graph holds them.
std::vector<PlacedKeyFrame> placed(const std::vector<Visit>& visits, const Visit& center,
                                   const Pose& T_map_world) {
  std::vector<PlacedKeyFrame> result;
  const Pose T_center_map = (T_map_world * center.T_world_lidar).inverse();
  for (const Visit& v : visits)
    result.push_back({unpack(v.key_frame), T_center_map * (T_map_world * v.T_world_lidar)});
  return result;
}

PlacedKeyFrame alone(const Visit& v) {
  return {unpack(v.key_frame), Pose::Identity()};
}

Pose far_and_turned(std::mt19937& random) {
  std::uniform_real_distribution<double> metres(-1e5, 1e5);
  std::uniform_real_distribution<double> turn(-M_PI, M_PI);
  Pose pose = Pose::Identity();
  pose.translation() << metres(random), metres(random), 1e-3 * metres(random);
  pose.linear() = rotation_from_rpy(0.0, 0.0, turn(random));
  return pose;
}

void expect_near(const Pose& estimate, const Pose& truth, double metres, double angle_deg) {
  const Pose error = truth.inverse() * estimate;
  EXPECT_LT(error.translation().norm(), metres);
  EXPECT_LT(degrees(rotation_angle(error)), angle_deg);
}

TEST(LoopVerifier, FindsTheQueryInTheFrameOfTheMatchAtAnyYawFarFromTheOrigin) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> offset(-0.8, 0.8);
  const std::vector<Visit> visits = visits_of_hall();
  const Visit& match = visits[3];
  for (int sector = 0; sector < 12; ++sector) {
    const double yaw_deg = 30.0 * sector + 10.0 * offset(random) - 180.0;
    const Pose at = match.T_world_lidar * pose_of(offset(random), offset(random), 0.0, yaw_deg);
    const Visit query = visit(hall(), at, static_cast<std::uint64_t>(100 + sector));
    const Pose T_map_world = far_and_turned(random);

    const double yaw = compare(query.context, match.context).yaw;
    const std::vector<Pose> guess{pose_of(0, 0, 0, degrees(yaw))};
    const std::vector<PlacedKeyFrame> source{alone(query)};
    const LoopVerification result =
        verify_loop(source, placed(visits, match, T_map_world), guess, kNoise, {});
    EXPECT_EQ(result.verdict, Verdict::accepted) << yaw_deg << " " << to_string(result.verdict);
    expect_near(result.T_match_query, match.T_world_lidar.inverse() * query.T_world_lidar, 0.05,
                0.3);
    EXPECT_LT(result.rmse, 0.1);
    EXPECT_GT(result.overlap, 0.7);
  }
}

TEST(LoopVerifier, TheCovarianceIsPositiveDefiniteAndSmall) {
  const std::vector<Visit> visits = visits_of_hall();
  const std::vector<PlacedKeyFrame> all = placed(visits, visits[3], Pose::Identity());
  const std::vector<Pose> guess{Pose::Identity()};
  const LoopVerification result = verify_loop(std::span(all).subspan(3, 1), all, guess, kNoise, {});
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(result.covariance);
  EXPECT_GT(eigen.eigenvalues()[0], 0.0);
  EXPECT_LT(eigen.eigenvalues()[5], 0.01 * 0.01);
}

TEST(LoopVerifier, RefusesAnotherPlace) {
  const std::vector<Visit> visits = visits_of_hall();
  for (const double x : {3.0, 20.0, -30.0}) {
    const Visit elsewhere = visit(street(), pose_of(x, 0, kMadeHeight, 40.0), 1);
    const double yaw = compare(elsewhere.context, visits[3].context).yaw;
    const std::vector<Pose> guess{pose_of(0, 0, 0, degrees(yaw))};
    const std::vector<PlacedKeyFrame> source{alone(elsewhere)};
    const LoopVerification result =
        verify_loop(source, placed(visits, visits[3], Pose::Identity()), guess, kNoise, {});
    EXPECT_NE(result.verdict, Verdict::accepted);
  }
}

TEST(LoopVerifier, RefusesACorridorThatDoesNotTellWhereAlongItTheQueryIs) {
  const Visit match = visit(corridor(), pose_of(0, 0, 1.5), 1);
  const Visit query = visit(corridor(), pose_of(3, 0, 1.5), 2);
  const std::vector<Pose> guess{Pose::Identity()};
  const std::vector<PlacedKeyFrame> source{alone(query)};
  const std::vector<PlacedKeyFrame> target{alone(match)};
  const LoopVerification result = verify_loop(source, target, guess, kNoise, {});
  EXPECT_EQ(result.verdict, Verdict::degenerate) << to_string(result.verdict);
}

TEST(LoopVerifier, NeighboursArePlacedByTheirOwnPoses) {
  // All of them at the pose of the match, as some implementations have it, smear the local map.
  const std::vector<Visit> visits = visits_of_hall();
  const std::vector<PlacedKeyFrame> own = placed(visits, visits[3], Pose::Identity());
  std::vector<PlacedKeyFrame> one = own;
  for (PlacedKeyFrame& p : one) p.T_frame_key = Pose::Identity();
  const std::vector<Pose> guess{pose_of(0, 0, 0, 24.0)};
  double right = 0.0;
  double smeared = 0.0;
  for (std::uint64_t seed = 70; seed < 80; ++seed) {
    const Visit query = visit(hall(), visits[3].T_world_lidar * pose_of(0.4, -0.3, 0, 25.0), seed);
    const std::vector<PlacedKeyFrame> source{alone(query)};
    const LoopVerification result = verify_loop(source, own, guess, kNoise, {});
    EXPECT_EQ(result.verdict, Verdict::accepted);
    right += result.rmse;
    smeared += verify_loop(source, one, guess, kNoise, {}).rmse;
  }
  EXPECT_LT(right, 0.5 * smeared);
}

TEST(LoopVerifier, TheBestOfSeveralGuessesWins) {
  const std::vector<Visit> visits = visits_of_hall();
  const Visit query = visit(hall(), visits[3].T_world_lidar * pose_of(0.4, -0.3, 0, 25.0), 77);
  const Pose truth = visits[3].T_world_lidar.inverse() * query.T_world_lidar;
  const std::vector<Pose> guesses{pose_of(0, 0, 0, 150.0), pose_of(0, 0, 0, 24.0),
                                  pose_of(5, 0, 0, -90.0)};
  const std::vector<PlacedKeyFrame> source{alone(query)};
  const LoopVerification result =
      verify_loop(source, placed(visits, visits[3], Pose::Identity()), guesses, kNoise, {});
  EXPECT_EQ(result.verdict, Verdict::accepted);
  expect_near(result.T_match_query, truth, 0.05, 0.3);
}

TEST(LoopVerifier, NothingToMatchIsNoMatch) {
  const KeyFrame empty;
  const std::vector<PlacedKeyFrame> nothing{{unpack(empty), Pose::Identity()}};
  const std::vector<Pose> guess{Pose::Identity()};
  EXPECT_EQ(verify_loop(nothing, nothing, guess, kNoise, {}).verdict, Verdict::no_match);
  EXPECT_EQ(verify_loop(nothing, nothing, {}, kNoise, {}).verdict, Verdict::no_match);
}

// A drive round the hall by a drifting odometry that ends near its start, looking elsewhere.
struct RoundTrip {
  std::vector<Visit> visits;
  KeyFrames key_frames;
  MapFragments pieces;
  PoseGraph graph{GraphSettings{}};
  std::vector<LoopReport> last_reports;
};

RoundTrip round_trip(double final_yaw_deg, std::mt19937& random) {
  constexpr int kVisits = 44;
  const Pose drift = pose_of(0.004, -0.003, 0.001, 0.02);
  RoundTrip drive;
  LoopSettings settings;
  settings.min_travel = 0.9 * (kVisits - 1) - 0.5;  // the last visit may only be the first again
  LoopCloser closer(settings, {}, kNoise);
  const Matrix6 covariance = Matrix6::Identity() * 1e-6;
  const Pose T_map_drifting = far_and_turned(random);
  for (int k = 0; k < kVisits; ++k) {
    const double turn = 360.0 * k / (kVisits - 1);
    const double yaw = k + 1 < kVisits ? turn + 90.0 : final_yaw_deg;
    const Pose at = pose_of(7.0 * std::cos(radians(turn)) + (k + 1 == kVisits ? 0.5 : 0.0),
                            5.0 * std::sin(radians(turn)), kMadeHeight, yaw);
    Visit v = visit(hall(), at, static_cast<std::uint64_t>(200 + k));
    v.key_frame.travelled = 0.9 * k;
    v.key_frame.reference_ns = 600'000'000LL * k;
    if (k == 0) {
      drive.graph.add_first(T_map_drifting);
    } else {
      const Pose step = drive.visits.back().T_world_lidar.inverse() * at * drift;
      drive.graph.add_key_frame({k - 1, k, step, covariance});
    }
    drive.key_frames.add(v.key_frame);
    drive.last_reports = closer.close(drive.key_frames, v.context, drive.pieces, drive.graph);
    drive.visits.push_back(std::move(v));
  }
  return drive;
}

TEST(LoopCloser, TheEdgeLeadsFromTheMatchToTheQueryInTheMatchsFrame) {
  std::mt19937 random(11);
  for (const double final_yaw_deg : {-150.0, 20.0, 100.0}) {
    const RoundTrip drive = round_trip(final_yaw_deg, random);
    ASSERT_EQ(drive.graph.loop_edges().size(), 1u) << final_yaw_deg;
    const PoseEdge& edge = drive.graph.loop_edges()[0];
    EXPECT_EQ(edge.to, static_cast<int>(drive.visits.size()) - 1);
    EXPECT_LT(edge.from, edge.to);
    const Pose truth =
        drive.visits[edge.from].T_world_lidar.inverse() * drive.visits[edge.to].T_world_lidar;
    expect_near(edge.T_from_to, truth, 0.05, 0.3);
    // The neighbours' own poses make the local map sharp; the same pose for all would not.
    EXPECT_GT(drive.last_reports.back().verification.overlap, 0.8);
    EXPECT_LT(drive.last_reports.back().verification.rmse, 0.075);
  }
}

// Five times round the hall, seeing the same each time.
TEST(LoopCloser, WhoDrivesTheSameRoundAgainAndAgainIsTiedOnceAndSearchedForSeldom) {
  constexpr int kVisits = 40;
  constexpr int kRounds = 5;
  constexpr double kStep = 1.0;  // m
  std::vector<Visit> visits;
  for (int k = 0; k < kVisits; ++k) {
    const double turn = 360.0 * k / kVisits;
    visits.push_back(visit(hall(),
                           pose_of(7.0 * std::cos(radians(turn)), 5.0 * std::sin(radians(turn)),
                                   kMadeHeight, turn + 90.0),
                           static_cast<std::uint64_t>(300 + k)));
  }
  KeyFrames key_frames;
  MapFragments pieces;
  PoseGraph graph{GraphSettings{}};
  LoopCloser closer({}, {}, kNoise);
  std::vector<int> added(kRounds), verified(kRounds);
  std::size_t places_of_first_rounds = 0;
  for (int k = 0; k < kVisits * kRounds; ++k) {
    Visit v = visits[k % kVisits];
    v.key_frame.travelled = kStep * k;
    if (k == 0) {
      graph.add_first(v.T_world_lidar);
    } else {
      const Pose step = visits[(k - 1) % kVisits].T_world_lidar.inverse() * v.T_world_lidar;
      graph.add_key_frame({k - 1, k, step, Matrix6::Identity() * 1e-4});
    }
    key_frames.add(v.key_frame);
    for (const LoopReport& report : closer.close(key_frames, v.context, pieces, graph)) {
      ++verified[k / kVisits];
      added[k / kVisits] += report.added;
    }
    if (k == 2 * kVisits) places_of_first_rounds = closer.places().size();
  }
  EXPECT_EQ(closer.places().size(), places_of_first_rounds);
  for (int round = 1; round < kRounds; ++round) {
    EXPECT_LE(added[round], 1) << round;
    EXPECT_GE(verified[round], 2) << round;
  }
  // At every third key frame if each loop were as good as the first.
  EXPECT_LE(verified[kRounds - 1], 7);
}

}  // namespace
}  // namespace lego_loam_sc
