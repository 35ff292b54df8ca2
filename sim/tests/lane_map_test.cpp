// SPDX-License-Identifier: BSD-3-Clause
#include "sim/lane_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/occupancy.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;

const Vector2d low(-20.0, -20.0), high(40.0, 30.0);

std::vector<Polyline> bent_and_straight() {
  Polyline bent;
  for (double x = -10.0; x <= 25.0; x += 1.0) bent.emplace_back(x, 6.0 * std::sin(x / 7.0));
  return {bent, {Vector2d(30.0, -15.0), Vector2d(32.0, 25.0)}};
}

double distance_by_hand(const std::vector<Polyline>& lanes, const Vector2d& place) {
  double nearest = 1e9;
  for (const Polyline& lane : lanes)
    for (std::size_t i = 1; i < lane.size(); ++i)
      for (int k = 0; k <= 5000; ++k)
        nearest =
            std::min(nearest, (lane[i - 1] + k / 5000.0 * (lane[i] - lane[i - 1]) - place).norm());
  return nearest;
}

TEST(SimLaneMap, CornersKnowTheirDistanceFromTheNearestLane) {
  const std::vector<Polyline> lanes = bent_and_straight();
  const LaneMap map(lanes, low, high, 1.0, 8.0);
  for (int i = 0; i < map.columns(); i += 7)
    for (int j = 0; j < map.rows(); j += 5)
      EXPECT_NEAR(map.distance(i, j), std::min(distance_by_hand(lanes, map.corner(i, j)), 8.0),
                  1e-4);
}

TEST(SimLaneMap, IsLinearBetweenCornersAndGoesOnBeyondItsEdge) {
  const LaneMap map(bent_and_straight(), low, high, 1.0, 8.0);
  const double expected = 0.25 * (map.distance(12, 14) + map.distance(13, 14) +
                                  map.distance(12, 15) + map.distance(13, 15));
  EXPECT_NEAR(map.distance(map.corner(12, 14) + Vector2d(0.5, 0.5)), expected, 1e-9);
  EXPECT_DOUBLE_EQ(map.distance(Vector2d(-500.0, 500.0)), 8.0);
}

TEST(SimOccupancy, TakesAFreePlaceOnce) {
  const LaneMap map(bent_and_straight(), low, high, 1.0, 8.0);
  Occupancy taken(map);
  const Footprint here{{0.0, 15.0}, {0.6, 0.8}, 4.0, 2.0};
  EXPECT_TRUE(taken.take(here, 2.0));
  EXPECT_FALSE(taken.take(here, 2.0));
  EXPECT_FALSE(taken.take({{1.0, 16.0}, {1.0, 0.0}, 1.0, 1.0}, 2.0));
  EXPECT_TRUE(taken.take({{5.0, 15.0}, {0.6, 0.8}, 4.0, 2.0}, 2.0));
}

TEST(SimOccupancy, KeepsTheLanesFree) {
  const LaneMap map(bent_and_straight(), low, high, 1.0, 8.0);
  Occupancy taken(map);
  EXPECT_FALSE(taken.take({{29.0, 15.0}, {0.0, 1.0}, 4.0, 2.0}, 2.0));  // 1.5 m from the lane
  EXPECT_TRUE(taken.take({{28.0, 15.0}, {0.0, 1.0}, 4.0, 2.0}, 2.0));   // the refused one took none
}

}  // namespace
}  // namespace lego_loam_sc
