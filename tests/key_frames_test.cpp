// SPDX-License-Identifier: BSD-3-Clause
#include "key_frames/key_frames.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "features/features.hpp"
#include "io/blob_file.hpp"
#include "io_test_files.hpp"
#include "key_frames/map_cloud.hpp"

namespace lego_loam_sc {
namespace {

std::vector<PackedPoint> some_points(int count, float x) {
  std::vector<PackedPoint> points;
  for (int i = 0; i < count; ++i)
    points.push_back(pack({x, 0.1f * static_cast<float>(i), 0.0f}, static_cast<float>(i)));
  return points;
}

KeyFrame made(int k) {
  const auto x = static_cast<float>(k);
  return {100 * k,
          0.5 * k,
          some_points(3 + k, x),
          some_points(k, x + 0.25f),
          some_points(2 * k, x + 0.5f),
          some_points(7, x + 0.75f)};
}

void expect_same(const std::vector<PackedPoint>& a, const std::vector<PackedPoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  if (a.empty()) return;
  EXPECT_EQ(std::memcmp(a.data(), b.data(), sizeof(PackedPoint) * a.size()), 0);
}

void expect_come_back(std::shared_ptr<BlobStore> store) {
  KeyFrames key_frames(std::move(store));
  for (int k = 0; k < 5; ++k) key_frames.add(made(k));
  ASSERT_EQ(key_frames.size(), 5u);
  for (const int k : {3, 0, 4, 1, 2}) {
    const KeyFrame back = key_frames[k];
    const KeyFrame own = made(k);
    EXPECT_EQ(back.reference_ns, own.reference_ns);
    EXPECT_EQ(key_frames.reference_ns(k), own.reference_ns);
    EXPECT_EQ(key_frames.travelled(k), own.travelled);
    expect_same(back.planars, own.planars);
    expect_same(back.edges, own.edges);
    expect_same(back.scattered, own.scattered);
    expect_same(back.others, own.others);
    EXPECT_EQ(key_frames.features(k).planars_large.size(), own.planars.size());
    EXPECT_EQ(key_frames.features(k).edges_large.size(), own.edges.size());
    EXPECT_EQ(key_frames.features(k).scattered.size(), own.scattered.size());
  }
}

TEST(KeyFrames, ComeBackFromMemoryAsTheyWere) {
  expect_come_back({});
}

TEST(KeyFrames, ComeBackFromAFileWhichIsGoneInTheEnd) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "points.bin";
  expect_come_back(std::make_shared<BlobFile>(path));
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(KeyFrames, TakeOverAStoreEmpty) {
  auto store = std::make_shared<MemoryBlobs>();
  KeyFrames(store).add(made(3));
  EXPECT_GT(store->size(), 0u);
  const KeyFrames fresh(store);
  EXPECT_EQ(store->size(), 0u);
  EXPECT_EQ(fresh.size(), 0u);
}

TEST(MapCloud, HoldsAllPointsOfAKeyFrameWhichStandInTheMapAtItsPose) {
  const KeyFrame own = made(3);
  const std::vector<MapPoint> points = points_of(own, 0);
  EXPECT_EQ(points.size(),
            own.planars.size() + own.edges.size() + own.scattered.size() + own.others.size());
  KeyFrames key_frames;
  key_frames.add(own);
  const Pose T_map_key(Eigen::Translation3d(10.0, 0.0, 0.0));
  const std::vector<MapPoint> map = make_map(key_frames, std::array{T_map_key}, 0.01);
  ASSERT_EQ(map.size(), points.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Eigen::Vector3f shift = map[i].position - points[i].position;
    EXPECT_LT((shift - Eigen::Vector3f(10.0f, 0.0f, 0.0f)).norm(), 1e-5f);
    EXPECT_EQ(map[i].intensity, points[i].intensity);
  }
}

TEST(BlobFile, SaysThatItCannotBeWrittenAndWhatIsMissing) {
  EXPECT_THROW(BlobFile("/dev/null/points.bin"), InputError);
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "points.bin";
  BlobFile file(path);
  std::vector<std::byte> bytes(100);
  file.append(bytes);
  std::filesystem::resize_file(path, 50);
  EXPECT_THROW(file.read(0, bytes), InputError);
}

}  // namespace
}  // namespace lego_loam_sc
