// SPDX-License-Identifier: BSD-3-Clause
#include "slam/back_end.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "key_frames/make_key_frame.hpp"
#include "made_scenes.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kNoise = 0.01;

// A key frame as a tracker would give it, from a scan of the hall without motion.
TrackedKeyFrame seen_from(const Pose& T_world_lidar, int number) {
  const SensorModel sensor = made_sensor(900);
  const Scan scan = take_scan(hall(), sensor, T_world_lidar,
                              {.noise = kNoise, .seed = static_cast<std::uint64_t>(500 + number)});
  const Staged s = through_stages(scan, sensor, kMadeHeight);
  TrackedKeyFrame result;
  result.number = number;
  result.scan = 10 * number;
  result.key_frame = make_key_frame(s.image, s.segmentation, s.features, s.image.points, 0.0, 0.3);
  result.key_frame.reference_ns = 600'000'000LL * number;
  result.key_frame.travelled = 0.9 * number;
  result.points = s.image.points;
  result.sensor_height = kMadeHeight;
  result.covariance = 1e-6 * Matrix6::Identity();
  return result;
}

// Once round the hall, back to the start: the tracker drifts by `drift` at each key frame.
struct Round {
  static constexpr int kKeyFrames = 44;
  std::vector<TrackedKeyFrame> key_frames;
  std::vector<Pose> truth;

  explicit Round(const Pose& drift) {
    for (int k = 0; k < kKeyFrames; ++k) {
      const double turn = 360.0 * k / (kKeyFrames - 1);
      truth.push_back(pose_of(7.0 * std::cos(radians(turn)), 5.0 * std::sin(radians(turn)),
                              kMadeHeight, turn + 90.0));
      TrackedKeyFrame key_frame = seen_from(truth.back(), k);
      key_frame.T_map_key = truth.front();
      if (k > 0) {
        key_frame.T_last_key = truth[k - 1].inverse() * truth[k] * drift;
        key_frame.T_map_key = key_frames.back().T_map_key * key_frame.T_last_key;
      }
      key_frames.push_back(std::move(key_frame));
    }
  }
};

BackEnd back_end_for(const std::shared_ptr<KeyFrames>& key_frames) {
  BackEndSettings settings;
  settings.loop.min_travel = 0.9 * (Round::kKeyFrames - 1) - 0.5;  // only the last may be a loop
  return {settings, kNoise, {}, key_frames};
}

double error_at_the_end(const std::vector<Pose>& T_map_key, const Round& round) {
  const Pose estimate = T_map_key.front().inverse() * T_map_key.back();
  const Pose truth = round.truth.front().inverse() * round.truth.back();
  return (truth.inverse() * estimate).translation().norm();
}

TEST(BackEnd, ClosesALoopOfKeyFramesAndHandsTheirPosesBack) {
  const Round round(pose_of(0.004, -0.003, 0.001, 0.02));
  const auto store = std::make_shared<KeyFrames>();
  BackEnd back_end = back_end_for(store);
  BackEnd::Result result;
  for (const TrackedKeyFrame& key_frame : round.key_frames) {
    EXPECT_FALSE(result.correction);
    result = back_end.add(key_frame);
  }
  ASSERT_TRUE(result.correction);
  EXPECT_TRUE(result.correction->accepted);
  EXPECT_EQ(result.correction->T_map_key.size(), round.key_frames.size());
  EXPECT_EQ(result.correction->places.front(), 0);
  ASSERT_FALSE(result.loops.empty());
  EXPECT_TRUE(result.loops.back().added);
  EXPECT_EQ(result.loops.back().query_scan, 10 * (Round::kKeyFrames - 1));
  EXPECT_EQ(store->size(), round.key_frames.size());

  std::vector<Pose> tracked;
  for (const TrackedKeyFrame& key_frame : round.key_frames) tracked.push_back(key_frame.T_map_key);
  EXPECT_GT(error_at_the_end(tracked, round), 0.1);
  EXPECT_LT(error_at_the_end(result.correction->T_map_key, round), 0.05);
}

// Where tracking was lost the relative pose is a guess, which the loop outweighs.
TEST(BackEnd, ALoopJoinsFragments) {
  Round round(Pose::Identity());
  TrackedKeyFrame& lost = round.key_frames[20];
  lost.starts_fragment = true;
  lost.T_last_key = lost.T_last_key * pose_of(8.0, 3.0, 0.5, 40.0);
  BackEnd back_end = back_end_for(std::make_shared<KeyFrames>());
  int corrections = 0;
  for (const TrackedKeyFrame& key_frame : round.key_frames)
    corrections += back_end.add(key_frame).correction.has_value();
  EXPECT_GE(corrections, 1);
  EXPECT_EQ(back_end.fragments().count(), 2);
  EXPECT_EQ(back_end.fragments().maps(), 1);
  EXPECT_LT(error_at_the_end(back_end.graph().poses(), round), 0.1);
}

}  // namespace
}  // namespace lego_loam_sc
