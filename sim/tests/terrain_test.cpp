// SPDX-License-Identifier: BSD-3-Clause
#include "sim/terrain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector2d low(-150.0, -150.0), high(150.0, 150.0);

// Round a circle of 80 m: laps over a hill; `drift` (m) is what each lap gains in height.
std::vector<Vector3d> laps(double count, double drift) {
  std::vector<Vector3d> way;
  for (double turn = 0.0; turn <= count; turn += 0.01) {
    const double angle = 2.0 * std::numbers::pi * turn;
    way.emplace_back(80.0 * std::cos(angle), 80.0 * std::sin(angle),
                     3.0 + 4.0 * std::sin(angle) + drift * turn);
  }
  return way;
}

TEST(SimTerrain, ClimbsAsTheWayDoes) {
  const std::vector<Vector3d> way = laps(0.7, 0.0);
  const Terrain terrain = Terrain::along(way, low, high);
  for (const Vector3d& point : way) EXPECT_NEAR(terrain.height(point.head<2>()), point.z(), 0.1);
}

TEST(SimTerrain, GivesAPlacePassedTwiceOneHeightAndSpreadsTheRest) {
  const double drift = 1.0;
  const std::vector<Vector3d> way = laps(2.0, drift);
  const Terrain terrain = Terrain::along(way, low, high);
  EXPECT_NEAR(terrain.height(way.front().head<2>()), way.front().z(), 0.05);
  double worst = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double climb = terrain.height(way[i].head<2>()) - terrain.height(way[i - 1].head<2>());
    worst = std::max(worst, std::abs(climb - (way[i].z() - way[i - 1].z())));
  }
  EXPECT_LT(worst, 0.03);  // m in 5 m of way: no step anywhere takes up the drift
}

TEST(SimTerrain, SlopeIsTheDerivativeOfTheHeight) {
  const Terrain terrain = Terrain::along(laps(1.0, 0.0), low, high);
  const double step = 1e-5;
  for (double x = -120.0; x < 120.0; x += 17.3) {
    for (double y = -120.0; y < 120.0; y += 19.1) {
      const Vector2d dx(step, 0.0), dy(0.0, step), place(x, y);
      const Vector2d slope = terrain.slope(place);
      EXPECT_NEAR(slope.x(), (terrain.height(place + dx) - terrain.height(place - dx)) / (2 * step),
                  1e-7);
      EXPECT_NEAR(slope.y(), (terrain.height(place + dy) - terrain.height(place - dy)) / (2 * step),
                  1e-7);
    }
  }
}

TEST(SimTerrain, AThingStandsUprightOnTheSlopeAndFacesItsYaw) {
  const Terrain terrain = Terrain::along(laps(1.0, 0.0), low, high);
  const Vector2d place(60.0, 45.0);
  const Pose pose = stand_on(terrain, place, 0.8);
  EXPECT_TRUE(pose.linear().isUnitary(1e-12));
  EXPECT_NEAR(pose.translation().z(), terrain.height(place), 1e-12);
  const Vector3d forward = pose.linear().col(0), up = pose.linear().col(2);
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), 0.8, 1e-12);
  const Vector2d slope = terrain.slope(place);
  EXPECT_NEAR(up.dot(Vector3d(1.0, 0.0, slope.x())), 0.0, 1e-12);
  EXPECT_NEAR(up.dot(Vector3d(0.0, 1.0, slope.y())), 0.0, 1e-12);
}

}  // namespace
}  // namespace lego_loam_sc
