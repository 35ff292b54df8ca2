// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/local_map_updater.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace lego_loam_sc {
namespace {

constexpr double kRadius = 400.0;

// Tells how many key frames were loaded: each has planar points alone.
class CountedBlobs : public MemoryBlobs {
 public:
  void read(std::uint64_t offset, std::span<std::byte> bytes) const override {
    loaded_ += !bytes.empty();
    MemoryBlobs::read(offset, bytes);
  }
  int loaded() const { return loaded_; }

 private:
  mutable int loaded_ = 0;
};

// A drive along the x axis whose every scan is a key frame.
struct Drive {
  std::shared_ptr<CountedBlobs> blobs = std::make_shared<CountedBlobs>();
  KeyFrames key_frames{blobs};
  std::vector<Pose> poses;
  int first_of_map = 0;  // key frame; those before it lie in another map
  Mapper mapper{{}, 0.01};
  LocalMapUpdater updater{kRadius};

  void go_to(double x) {
    Pose pose = Pose::Identity();
    pose.translation().x() = x;
    KeyFrame key_frame;
    key_frame.planars = {pack({1.0f, 2.0f, 0.0f}, 0.0f)};
    key_frames.add(key_frame);
    updater.add(static_cast<int>(poses.size()), pose);
    poses.push_back(pose);
  }

  bool correct(bool accepted = true) {
    Correction correction{poses, accepted, {}};
    for (int k = first_of_map; k < static_cast<int>(poses.size()); ++k)
      correction.places.push_back(k);
    return updater.on_graph_update(correction, key_frames, mapper);
  }

  // Key frames that the scans to come insert.
  int inserted_later() {
    const int before = blobs->loaded();
    for (int scan = 0; scan < 1000; ++scan) updater.insert_pending(key_frames, mapper);
    return blobs->loaded() - before;
  }
};

TEST(LocalMapUpdater, LeavesTheMapAloneWhileKeyFramesStayWhereTheyAre) {
  Drive drive;
  for (int k = 0; k < 20; ++k) drive.go_to(10.0 * k);
  for (Pose& pose : drive.poses) pose.translation().y() += 0.02;
  EXPECT_FALSE(drive.correct());
  EXPECT_EQ(drive.inserted_later(), 0);
}

TEST(LocalMapUpdater, RebuildsTheMapWhenKeyFramesHaveMoved) {
  Drive drive;
  for (int k = 0; k < 20; ++k) drive.go_to(10.0 * k);
  drive.poses[7].translation().y() += 0.05;
  EXPECT_TRUE(drive.correct());
  const int at_once = drive.blobs->loaded();
  EXPECT_GT(at_once, 0);
  EXPECT_LT(at_once, 20);
  EXPECT_EQ(at_once + drive.inserted_later(), 20);
  EXPECT_FALSE(drive.mapper.empty());
}

// Five times over the same ten places, each 10 m from the next, then away and back to the first:
// the map has forgotten all of them and is there again with one of each place, but for the present.
TEST(LocalMapUpdater, InsertsOneKeyFrameOfEachPlace) {
  Drive drive;
  for (int round = 0; round < 5; ++round)
    for (int k = 0; k < 10; ++k) drive.go_to(10.0 * k + 0.1 * round);
  drive.go_to(500.0);
  drive.go_to(0.0);
  EXPECT_FALSE(drive.correct());
  EXPECT_EQ(drive.inserted_later(), 9);
}

// A loop that was taken out again moves what is still to be inserted, and nothing else.
TEST(LocalMapUpdater, ARefusedLoopLeavesTheMapAlone) {
  Drive drive;
  for (int k = 0; k < 20; ++k) drive.go_to(10.0 * k);
  drive.poses[7].translation().y() += 0.05;
  EXPECT_FALSE(drive.correct(false));
  EXPECT_EQ(drive.inserted_later(), 0);
  EXPECT_TRUE(drive.correct(true));
}

TEST(LocalMapUpdater, OtherMapsStayOut) {
  Drive drive;
  for (int k = 0; k < 10; ++k) drive.go_to(10.0 * k);
  drive.go_to(500.0);
  drive.first_of_map = static_cast<int>(drive.poses.size());
  drive.updater.clear();
  drive.go_to(0.5);
  EXPECT_FALSE(drive.correct());
  EXPECT_EQ(drive.inserted_later(), 0);
  drive.first_of_map = 0;
  EXPECT_FALSE(drive.correct());
  EXPECT_EQ(drive.inserted_later(), 9);
}

}  // namespace
}  // namespace lego_loam_sc
