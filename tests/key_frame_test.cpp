// SPDX-License-Identifier: BSD-3-Clause
#include "key_frames/key_frame.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

#include "key_frames/make_key_frame.hpp"
#include "made_scenes.hpp"
#include "map/voxel_table.hpp"

namespace lego_loam_sc {
namespace {

TEST(KeyFrame, APackedPointTakesEightBytesAndIsOffByHalfAStep) {
  EXPECT_EQ(sizeof(PackedPoint), 8u);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-160.0f, 160.0f);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3f point(place(random), place(random), place(random));
    const Eigen::Vector3f off = pack(point, 0.0f).position() - point;
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 0.5f * PackedPoint::kStep + 2e-5f);
  }
}

TEST(KeyFrame, PointsOutOfReachAreClampedAndNotWrappedRound) {
  const PackedPoint packed = pack({1000.0f, -1000.0f, 1e30f}, 1e30f);
  EXPECT_NEAR(packed.position().x(), 163.835f, 1e-3f);
  EXPECT_NEAR(packed.position().y(), -163.835f, 1e-3f);
  EXPECT_NEAR(packed.position().z(), 163.835f, 1e-3f);
  EXPECT_EQ(static_cast<float>(packed.intensity), 65504.0f);
}

TEST(KeyFrame, IntensityIsKeptToAThousandth) {
  for (const float intensity : {0.0f, 0.25f, 0.7231f, 37.0f, 255.0f, 3000.0f})
    EXPECT_NEAR(static_cast<float>(pack({1, 2, 3}, intensity).intensity), intensity,
                1e-3f * intensity);
}

TEST(KeyFrame, UnpackedPointsAreTheSamePointsInTheirOrder) {
  const std::vector<PackedPoint> points{pack({1, 2, 3}, 1), pack({-4, 5, -6}, 2)};
  KeyFrame key_frame;
  key_frame.edges = points;
  const std::vector<FeaturePoint> features = unpack(key_frame).edges_large;
  ASSERT_EQ(features.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(features[i].position, points[i].position());
    EXPECT_EQ(features[i].time, 0.0f);
  }
}

TEST(KeyFrame, HoldsOnePointOfEachVoxelAndNoneTwice) {
  constexpr double kSpacing = 0.3;
  const SensorModel sensor = made_sensor();
  const Scan scan = take_scan(street(), sensor, pose_of(0, 0, kMadeHeight), {.stamp_ns = 5'000});
  const Staged s = through_stages(scan, sensor, kMadeHeight);
  const KeyFrame key_frame =
      make_key_frame(s.image, s.segmentation, s.features, s.image.points, 12.5, kSpacing);
  EXPECT_EQ(key_frame.reference_ns, 5'000);
  EXPECT_EQ(key_frame.travelled, 12.5);
  EXPECT_FALSE(key_frame.planars.empty());
  EXPECT_FALSE(key_frame.edges.empty());
  EXPECT_FALSE(key_frame.others.empty());
  EXPECT_LT(key_frame.planars.size(), s.features.planars_large.size());

  // Rounding may move a point that lies on the border of its voxel to the next.
  const auto voxels = [&](const std::vector<PackedPoint>& points) {
    std::set<VoxelKey> keys;
    for (const PackedPoint& p : points)
      keys.insert(*key_of(p.position().cast<double>() / kSpacing));
    return keys;
  };
  for (const auto* cloud : {&key_frame.planars, &key_frame.edges, &key_frame.others})
    EXPECT_GT(static_cast<double>(voxels(*cloud).size()), 0.9 * static_cast<double>(cloud->size()));
  const std::set<VoxelKey> planars = voxels(key_frame.planars);
  std::size_t doubled = 0;
  for (const VoxelKey key : voxels(key_frame.others)) doubled += planars.contains(key);
  EXPECT_LT(static_cast<double>(doubled), 0.1 * static_cast<double>(planars.size()));
}

}  // namespace
}  // namespace lego_loam_sc
