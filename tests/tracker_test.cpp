// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracker.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "made_drive.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kSpeed = 5.0;

// A tracker without a back end.
Tracker lone_tracker(std::shared_ptr<KeyFrames> key_frames = std::make_shared<KeyFrames>()) {
  return {made_sensor(900), TrackerSettings{}, std::move(key_frames)};
}

TEST(Tracker, FollowsADriveWithoutABackEnd) {
  const std::vector<Scan> scans = drive(40, kSpeed);
  Tracker tracker = lone_tracker();
  int key_frames = 0;
  Pose T_map_key = Pose::Identity();
  std::vector<Pose> live, mapped;
  for (const Scan& scan : scans) {
    const TrackedScan tracked = tracker.track(scan);
    EXPECT_EQ(tracked.status, Status::ok);
    if (tracked.key_frame) {
      EXPECT_EQ(tracked.key_frame->number, key_frames++);
      EXPECT_EQ(tracked.key_frame->scan, tracked.index);
      EXPECT_FALSE(tracked.key_frame->starts_fragment);
      T_map_key = tracked.key_frame->T_map_key;
    }
    EXPECT_EQ(tracked.last_key_frame, key_frames - 1);
    live.push_back(tracked.T_odom_lidar);
    mapped.push_back(T_map_key * tracked.T_key_lidar);
  }
  EXPECT_GT(key_frames, 3);
  const Pose truth = truth_between(0, 39, kSpeed);
  for (const std::vector<Pose>& poses : {live, mapped}) {
    const Pose error = truth.inverse() * poses.front().inverse() * poses.back();
    EXPECT_LT(error.translation().norm(), 0.05);
    EXPECT_LT(degrees(rotation_angle(error)), 0.5);
  }
}

TEST(Tracker, ADriveThatBeginsAtSpeedReplacesItsFirstScanOnce) {
  const int skipped = 15;
  const std::vector<Scan> scans = drive(skipped + 4, kSpeed);
  Tracker tracker = lone_tracker();
  EXPECT_FALSE(tracker.may_reprocess());
  const TrackedScan first = tracker.track(scans[skipped]);
  EXPECT_TRUE(first.key_frame.has_value());
  EXPECT_TRUE(tracker.may_reprocess());
  Scan late = scans[skipped];
  EXPECT_EQ(tracker.track(late).status, Status::out_of_order);
  const TrackedScan second = tracker.track(scans[skipped + 1]);
  EXPECT_FALSE(tracker.may_reprocess());
  ASSERT_TRUE(second.first_again);
  EXPECT_EQ(second.index, 2);
  EXPECT_EQ(second.first_again->index, 0);
  ASSERT_TRUE(second.first_again->key_frame);
  EXPECT_EQ(second.first_again->key_frame->number, 0);
  EXPECT_EQ(second.fragment, 0);
  const TrackedScan third = tracker.track(scans[skipped + 2]);
  EXPECT_FALSE(third.first_again);
  EXPECT_EQ(third.index, 3);
}

// A tracker with the key frames that it gave, as a back end would keep them.
struct Follower {
  std::shared_ptr<KeyFrames> key_frames = std::make_shared<KeyFrames>();
  Tracker tracker = lone_tracker(key_frames);
  std::vector<Pose> T_map_key;
  TrackedScan last;

  void take(const Scan& scan) {
    last = tracker.track(scan);
    ASSERT_EQ(last.status, Status::ok);
    if (!last.key_frame) return;
    key_frames->add(last.key_frame->key_frame);
    T_map_key.push_back(last.key_frame->T_map_key);
  }

  void correct(const Pose& T_new_old) {
    Correction correction;
    correction.accepted = true;
    for (Pose& pose : T_map_key) pose = T_new_old * pose;
    correction.T_map_key = T_map_key;
    for (int k = 0; k < static_cast<int>(T_map_key.size()); ++k) correction.places.push_back(k);
    tracker.correct(correction);
  }

  Pose T_map_lidar() const { return T_map_key[last.last_key_frame] * last.T_key_lidar; }
};

TEST(Tracker, ACorrectionMovesTheMapButNotTheLivePose) {
  const std::vector<Scan> scans = drive(60, kSpeed);
  const Pose T_new_old = pose_of(0.4, -0.3, 0.1, 5.0);
  Follower plain, corrected;
  bool is_corrected = false;
  for (int k = 0; k < static_cast<int>(scans.size()); ++k) {
    plain.take(scans[k]);
    corrected.take(scans[k]);
    if (!is_corrected && k > 40 && corrected.last.key_frame) {
      corrected.correct(T_new_old);
      is_corrected = true;
    }
    const Pose expected =
        is_corrected ? Pose(T_new_old * plain.T_map_lidar()) : plain.T_map_lidar();
    const Pose error = expected.inverse() * corrected.T_map_lidar();
    EXPECT_LT(error.translation().norm(), 0.03) << k;
    EXPECT_LT(degrees(rotation_angle(error)), 0.2) << k;
    const Pose moved = plain.last.T_odom_lidar.inverse() * corrected.last.T_odom_lidar;
    EXPECT_LT(moved.translation().norm(), 0.03) << k;
  }
  EXPECT_TRUE(is_corrected);
}

// A driver repeats its last scan.
TEST(Tracker, ARepeatedScanIsNoMotion) {
  const std::vector<Scan> scans = drive(12, kSpeed);
  Tracker tracker = lone_tracker();
  TrackedScan last;
  for (int k = 0; k < 10; ++k) last = tracker.track(scans[static_cast<std::size_t>(k)]);
  for (int k = 1; k <= 3; ++k) {
    Scan again = scans[9];
    again.stamp_ns += k * 10'000'000;
    const TrackedScan repeated = tracker.track(again);
    EXPECT_EQ(repeated.status, Status::repeated);
    EXPECT_EQ(repeated.index, 9 + k);
    EXPECT_TRUE(repeated.T_odom_lidar.isApprox(last.T_odom_lidar, 0.0));
    EXPECT_TRUE(repeated.T_key_lidar.isApprox(last.T_key_lidar, 0.0));
    EXPECT_FALSE(repeated.key_frame.has_value());
  }
  const TrackedScan next = tracker.track(scans[10]);
  EXPECT_EQ(next.status, Status::ok);
  const Pose motion = last.T_odom_lidar.inverse() * next.T_odom_lidar;
  EXPECT_LT((truth_between(9, 10, kSpeed).inverse() * motion).translation().norm(), 0.03);
}

}  // namespace
}  // namespace lego_loam_sc
