// SPDX-License-Identifier: BSD-3-Clause
#include "features/features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "made_scenes.hpp"
#include "map/voxel_filter.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

using Key = std::tuple<int, int, float, float, float>;

Key key_of_point(const FeaturePoint& p) {
  return {p.row, p.column, p.position.x(), p.position.y(), p.position.z()};
}

std::set<Key> keys(const std::vector<FeaturePoint>& points) {
  std::set<Key> result;
  for (const FeaturePoint& p : points) result.insert(key_of_point(p));
  return result;
}

bool contains(const std::vector<FeaturePoint>& large, const std::vector<FeaturePoint>& small) {
  const std::set<Key> all = keys(large);
  return std::all_of(small.begin(), small.end(),
                     [&](const FeaturePoint& p) { return all.contains(key_of_point(p)); });
}

Features features_of(const Scene& scene, const Pose& T_world_lidar, double noise = 0.0,
                     const Settings& settings = {}) {
  const SensorModel sensor = made_sensor();
  const Scan scan = take_scan(scene, sensor, T_world_lidar, {.noise = noise, .seed = 3});
  return through_stages(scan, sensor, T_world_lidar.translation().z(), settings).features;
}

Settings with_counts() {
  Settings settings;
  settings.features.edges_sharp = 2;
  settings.features.edges_large = 4;
  settings.features.planars_flat = 3;
  settings.features.planars_large = 7;
  return settings;
}

TEST(Features, TheSmallSetsArePartOfTheLargeOnesAndNothingIsDoubled) {
  for (const Settings& settings : {Settings{}, with_counts()}) {
    const Features f = features_of(street(), pose_of(0, 0, kMadeHeight), 0.01, settings);
    EXPECT_GT(f.edges_sharp.size(), 50u);
    EXPECT_GT(f.planars_flat.size(), 50u);
    EXPECT_GT(f.edges_large.size(), f.edges_sharp.size());
    EXPECT_GT(f.planars_large.size(), f.planars_flat.size());
    EXPECT_TRUE(contains(f.edges_large, f.edges_sharp));
    EXPECT_TRUE(contains(f.planars_large, f.planars_flat));
    for (const auto* set : {&f.edges_sharp, &f.edges_large, &f.planars_flat, &f.planars_large})
      EXPECT_EQ(keys(*set).size(), set->size());
    const std::set<Key> edges = keys(f.edges_large);
    for (const Key& key : keys(f.planars_large)) EXPECT_FALSE(edges.contains(key));
  }
}

TEST(Features, AtMostTheAskedForCountComesFromEachRowAndSubImage) {
  const Settings settings = with_counts();
  const Features f = features_of(street(), pose_of(0, 0, kMadeHeight), 0.01, settings);
  const auto most = [](const std::vector<FeaturePoint>& points) {
    std::map<std::pair<int, int>, int> count;
    int result = 0;
    for (const FeaturePoint& p : points)
      result = std::max(result, ++count[{p.row, p.column * 6 / 1800}]);
    return result;
  };
  EXPECT_EQ(most(f.edges_sharp), 2);
  EXPECT_EQ(most(f.edges_large), 4);
  EXPECT_EQ(most(f.planars_flat), 3);
  EXPECT_EQ(most(f.planars_large), 7);
}

TEST(Features, AscendInRowAndColumn) {
  const Features f = features_of(street(), pose_of(0, 0, kMadeHeight), 0.01);
  for (const auto* set : {&f.edges_sharp, &f.edges_large, &f.planars_flat, &f.planars_large}) {
    EXPECT_TRUE(std::is_sorted(set->begin(), set->end(), [](const auto& a, const auto& b) {
      return std::pair(a.row, a.column) < std::pair(b.row, b.column);
    }));
  }
}

// Were points taken for their noise, as by a greedy walk that takes the first one far enough from
// the last, those of a wall would be too near where the scan approaches it and too far where it
// leaves: all walls turned alike, and a map of them turns a little more with every scan.
TEST(Features, NoiseDoesNotTurnTheWallsThroughTheChoiceOfPoints) {
  Scene walls;
  walls.plane({0, 0, 0}, {0, 0, 1}).plane({0, 8, 0}, {0, 1, 0}).plane({0, -8, 0}, {0, 1, 0});
  SensorModel sensor = made_sensor();
  sensor.range_noise = 0.02;
  double turned = 0.0, turned_and_thinned = 0.0;
  int count = 0, thinned_count = 0;
  const auto outwards = [](const FeaturePoint& p) {
    return std::copysign(std::abs(p.position.y()) - 8.0, p.position.x() * p.position.y());
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scan scan =
        take_scan(walls, sensor, pose_of(0, 0, kMadeHeight), {.noise = 0.02, .seed = seed});
    std::vector<FeaturePoint> planars =
        through_stages(scan, sensor, kMadeHeight, {}).features.planars_large;
    std::erase_if(planars, [](const FeaturePoint& p) { return std::abs(p.position.y()) < 7.0f; });
    for (const FeaturePoint& p : planars) turned += outwards(p);
    count += static_cast<int>(planars.size());
    for (const FeaturePoint& p :
         voxel_filter(planars, 1.0, [](const FeaturePoint& q) { return q.position; })) {
      turned_and_thinned += outwards(p);
      ++thinned_count;
    }
  }
  ASSERT_GT(count, 20000);
  ASSERT_GT(thinned_count, 5000);
  // The noise across the wall has less than 2 cm, so these are five sigmas of the means.
  EXPECT_NEAR(turned / count, 0.0, 5.0 * 0.02 / std::sqrt(count));
  EXPECT_NEAR(turned_and_thinned / thinned_count, 0.0, 5.0 * 0.02 / std::sqrt(thinned_count));
}

TEST(Features, EdgesAreNeverOnTheGroundAndFlatPointsAlwaysWhenThereIsEnough) {
  const Features f = features_of(street(), pose_of(0, 0, kMadeHeight), 0.01);
  for (const FeaturePoint& p : f.edges_large) EXPECT_NE(p.label, Label::ground);
  for (const FeaturePoint& p : f.planars_flat) EXPECT_EQ(p.label, Label::ground);
}

TEST(Features, WithoutEnoughGroundFlatPointsComeFromEverywhere) {
  Scene room;  // the floor is out of sight
  room.box({-6, -5, -50}, {7, 4, 50});
  const Features f = features_of(room, pose_of(0, 0, 1.0), 0.01);
  EXPECT_GT(f.planars_flat.size(), 100u);
}

TEST(Features, ACornerOfARoomIsAnEdge) {
  Scene room;
  room.box({-6, -5, -50}, {7, 4, 50});
  const Features f = features_of(room, pose_of(0, 0, 1.0));
  for (const auto& [x, y] : {std::pair(-6.0, -5.0), {-6.0, 4.0}, {7.0, -5.0}, {7.0, 4.0}}) {
    const auto near =
        std::count_if(f.edges_sharp.begin(), f.edges_sharp.end(), [&](const FeaturePoint& p) {
          return (p.position.head<2>().cast<double>() - Eigen::Vector2d(x, y)).norm() < 0.1;
        });
    EXPECT_EQ(near, 16);  // one in each row
  }
}

TEST(Features, AWallMakesNoEdgesOfTheNoiseThatIsAskedFor) {
  Scene wall;
  wall.box({-5, -5, -50}, {5, 5, 50});
  Settings settings;
  settings.features.noise_factor = 5.0;  // exceeded once in a million
  const Features f = features_of(wall, pose_of(0, 0, 1.0), 0.01, settings);
  for (const FeaturePoint& p : f.edges_large) {
    const Vector3d q = p.position.cast<double>();
    EXPECT_LT((q.head<2>().cwiseAbs() - Eigen::Vector2d(5, 5)).norm(), 0.2) << q.transpose();
  }
  EXPECT_GT(f.edges_large.size(), 56u);  // of four corners in sixteen rows
}

TEST(Features, ALongFlatWallMakesNoEdges) {
  // Seen ever more flatly along the wall, the range itself is curved.
  for (const double distance : {2.0, 5.0}) {
    Scene wall;
    wall.plane({0, distance, 0}, Vector3d::UnitY());
    const Features f = features_of(wall, pose_of(0, 0, 1.0));
    EXPECT_TRUE(f.edges_large.empty()) << f.edges_large.size() << " edges";
    EXPECT_GT(f.planars_large.size(), 100u);
  }
}

TEST(Features, ABorderThatIsHiddenByANearerObjectIsNoEdge) {
  Scene scene;
  scene.plane({12, 0, 0}, Vector3d::UnitX());
  scene.box({5, -1, -20}, {6, 1, 20});
  for (const int suppressed : {0, 5}) {
    Settings settings;
    settings.features.suppressed_neighbours = suppressed;
    const Features f = features_of(scene, pose_of(0, 0, 1.0), 0.0, settings);
    std::set<std::pair<int, bool>> corners;  // row and side
    for (const FeaturePoint& p : f.edges_large) {
      const Vector3d q = p.position.cast<double>();
      const double azimuth = std::abs(std::atan2(q.y(), q.x()));
      // The shadow of the box ends at the azimuth of its front corners.
      const bool at_the_shadow = std::abs(azimuth - std::atan2(1.0, 5.0)) < radians(1.2);
      EXPECT_FALSE(q.x() > 11.0 && at_the_shadow) << q.transpose();
      if (q.x() < 7.0 && at_the_shadow) corners.emplace(p.row, q.y() > 0.0);
    }
    EXPECT_EQ(corners.size(), 2u * 16u);
  }
}

TEST(Features, WhatStandsOnTheGroundAndIsRoughIsScattered) {
  Scene field;
  field.plane({0, 0, 0}, Eigen::Vector3d::UnitZ());
  for (int k = 0; k < 8; ++k)
    field.pole(12.0 * std::cos(0.8 * k), 12.0 * std::sin(0.8 * k), 0.15, 0, 6);
  const SensorModel sensor = made_sensor(900);
  const auto in = [&](const Scene& scene) {
    return through_stages(take_scan(scene, sensor, pose_of(0, 0, kMadeHeight), {.noise = 0.01}),
                          sensor, kMadeHeight)
        .features;
  };
  const Features features = in(field);
  EXPECT_GT(features.scattered.size(), 40u);
  for (const FeaturePoint& p : features.scattered) {
    EXPECT_NEAR(p.position.head<2>().norm(), 12.0, 0.3);
    EXPECT_NE(p.label, Label::ground);
  }

  Settings settings;
  settings.features.scattered = 20;
  const Scan scan = take_scan(field, sensor, pose_of(0, 0, kMadeHeight), {.noise = 0.01});
  EXPECT_EQ(through_stages(scan, sensor, kMadeHeight, settings).features.scattered.size(), 20u);
  settings.features.scattered = 0;
  EXPECT_TRUE(through_stages(scan, sensor, kMadeHeight, settings).features.scattered.empty());
}

TEST(Features, NothingHasNoFeatures) {
  const Features f = through_stages({}, made_sensor(), 0.0).features;
  EXPECT_TRUE(f.edges_large.empty() && f.planars_large.empty());
}

}  // namespace
}  // namespace lego_loam_sc
