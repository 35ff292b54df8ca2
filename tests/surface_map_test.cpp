// SPDX-License-Identifier: BSD-3-Clause
#include "map/surface_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "map/voxel_filter.hpp"
#include "map/voxel_table.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr double kVoxel = 0.5;
constexpr double kSigma = 0.02;

// Noisy points of the disc of radius 1 m round `center`, across `normal`.
std::vector<Vector3d> disc(const Vector3d& center, const Vector3d& normal, int count,
                           unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(-1.0, 1.0);
  std::normal_distribution<double> off(0.0, kSigma);
  const Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.cross(u);
  std::vector<Vector3d> points;
  while (static_cast<int>(points.size()) < count) {
    const double a = along(random), b = along(random);
    if (a * a + b * b < 1.0) points.push_back(center + a * u + b * v + off(random) * normal);
  }
  return points;
}

std::vector<Vector3d> rod(const Vector3d& center, const Vector3d& direction, int count,
                          unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(-1.5, 1.5);
  std::normal_distribution<double> off(0.0, kSigma);
  const Vector3d u = direction.unitOrthogonal();
  const Vector3d v = direction.cross(u);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i)
    points.push_back(center + along(random) * direction + off(random) * u + off(random) * v);
  return points;
}

Surface surface_at(SurfaceMap& map, const Vector3d& point) {
  return map.surface_of(map.block_of(point));
}

double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::asin(std::min(a.cross(b).norm(), 1.0));
}

void expect_plane(const Surface& surface, const Vector3d& on_plane, const Vector3d& normal) {
  ASSERT_EQ(surface.kind, Surface::Kind::plane);
  EXPECT_LT(angle_between(surface.direction, normal), 0.01);
  EXPECT_LT(std::abs(normal.dot(surface.mean - on_plane)), 0.003);
  EXPECT_NEAR(std::sqrt(surface.variance), kSigma, 0.2 * kSigma);
  EXPECT_NEAR(surface.direction.norm(), 1.0, 1e-6);
}

TEST(SurfaceMap, FitsAPlaneThroughNoisyPointsWhereverItLiesAmongTheVoxels) {
  const Vector3d normal = Vector3d(1.0, -2.0, 4.0).normalized();
  for (int k = 0; k < 40; ++k) {
    const Vector3d center = k * Vector3d(0.013, 0.027, 0.041) + Vector3d(7.0, -3.0, 1.0);
    SurfaceMap map({Surface::Kind::plane, kVoxel, 0.1});
    map.insert(disc(center, normal, 4000, 1));
    expect_plane(surface_at(map, center), center, normal);
  }
}

TEST(SurfaceMap, FitsALineThroughNoisyPointsWhereverItLiesAmongTheVoxels) {
  const Vector3d direction = Vector3d(0.2, 0.3, 1.0).normalized();
  for (int k = 0; k < 40; ++k) {
    const Vector3d center = k * Vector3d(0.013, 0.027, 0.041) + Vector3d(-2.0, 9.0, 0.0);
    SurfaceMap map({Surface::Kind::line, kVoxel, 0.1});
    map.insert(rod(center, direction, 3000, 2));
    const Surface surface = surface_at(map, center);
    ASSERT_EQ(surface.kind, Surface::Kind::line);
    EXPECT_LT(angle_between(surface.direction, direction), 0.01);
    const Vector3d off = surface.mean - center;
    EXPECT_LT((off - direction.dot(off) * direction).norm(), 0.003);
  }
}

TEST(SurfaceMap, APlaneOnTheBorderOfVoxelsIsNotCutInTwo) {
  for (const double z : {0.0, 0.25, 0.5, -0.5}) {
    SurfaceMap map({Surface::Kind::plane, kVoxel, 0.1});
    map.insert(disc({0.1, 0.1, z}, Vector3d::UnitZ(), 4000, 3));
    for (const double off : {-0.2, -0.01, 0.0, 0.01, 0.2})
      expect_plane(surface_at(map, {0.1, 0.1, z + off}), {0.0, 0.0, z}, Vector3d::UnitZ());
  }
}

TEST(SurfaceMap, IsAsExactFarFromTheOrigin) {
  const Vector3d normal = Vector3d(3.0, 1.0, -1.0).normalized();
  const Vector3d center(100'000.3, -99'999.7, 99'000.1);
  SurfaceMap map({Surface::Kind::plane, kVoxel, 0.1});
  map.insert(disc(center, normal, 4000, 4));
  expect_plane(surface_at(map, center), center, normal);
}

TEST(SurfaceMap, MorePointsMakeTheFitBetter) {
  const Vector3d normal = Vector3d(0.3, 0.1, 1.0).normalized();
  const Vector3d center(1.0, 2.0, 3.0);
  SurfaceMap map({Surface::Kind::plane, kVoxel, 0.5});
  map.insert(disc(center, normal, 60, 5));
  const double before = angle_between(surface_at(map, center).direction, normal);
  for (unsigned seed = 6; seed < 26; ++seed) {
    map.insert(disc(center, normal, 500, seed));
    surface_at(map, center);
  }
  EXPECT_LT(angle_between(surface_at(map, center).direction, normal), 0.2 * before);
  expect_plane(surface_at(map, center), center, normal);
}

TEST(SurfaceMap, APlaceWithoutAClearSurfaceHasNone) {
  SurfaceMap planes({Surface::Kind::plane, kVoxel, 0.1});
  EXPECT_EQ(surface_at(planes, {0, 0, 0}).kind, Surface::Kind::none);
  planes.insert(disc({0.1, 0.1, 0.1}, Vector3d::UnitZ(), 5, 7));  // too few
  EXPECT_EQ(surface_at(planes, {0.1, 0.1, 0.1}).kind, Surface::Kind::none);
  planes.insert(rod({20.1, 0.1, 0.1}, Vector3d::UnitZ(), 1000, 8));
  EXPECT_EQ(surface_at(planes, {20.1, 0.1, 0.1}).kind, Surface::Kind::none);
  for (int axis = 0; axis < 3; ++axis)  // a corner
    planes.insert(disc({-20.1, 0.1, 0.1}, Vector3d::Unit(axis), 500, 9));
  EXPECT_EQ(surface_at(planes, {-20.1, 0.1, 0.1}).kind, Surface::Kind::none);
  planes.insert(std::vector<Vector3d>(100, Vector3d(50.0, 0.0, 0.0)));
  EXPECT_EQ(surface_at(planes, {50.0, 0.0, 0.0}).kind, Surface::Kind::none);
  SurfaceMap lines({Surface::Kind::line, kVoxel, 0.1});
  lines.insert(disc({0.1, 0.1, 0.1}, Vector3d::UnitZ(), 1000, 10));
  EXPECT_EQ(surface_at(lines, {0.1, 0.1, 0.1}).kind, Surface::Kind::none);
}

TEST(SurfaceMap, PlacesOutOfReachOrNotFiniteHaveNothing) {
  SurfaceMap map({Surface::Kind::plane, kVoxel, 0.1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vector3d> bad{{nan, 0, 0}, {1e30, 0, 0}, {0, -6e5, 0}};
  for (int k = 0; k < 10; ++k) map.insert(bad);
  EXPECT_EQ(map.size(), 0u);
  for (const Vector3d& p : bad) {
    EXPECT_EQ(surface_at(map, p).kind, Surface::Kind::none);
    EXPECT_FALSE(map.occupied(p));
  }
}

TEST(SurfaceMap, ForgetsWhatIsFarAwayAndKeepsTheRest) {
  SurfaceMap map({Surface::Kind::plane, kVoxel, 0.1});
  const Vector3d here(1.0, 1.0, 1.0), there(50.0, 1.0, 1.0);
  for (const Vector3d& center : {here, there}) {
    map.insert(disc(center, Vector3d::UnitZ(), 2000, 11));
    expect_plane(surface_at(map, center), center, Vector3d::UnitZ());
    EXPECT_TRUE(map.occupied(center));
  }
  map.remove_beyond(here, 20.0);
  expect_plane(surface_at(map, here), here, Vector3d::UnitZ());
  EXPECT_EQ(surface_at(map, there).kind, Surface::Kind::none);
  EXPECT_FALSE(map.occupied(there));
  map.clear();
  EXPECT_EQ(map.size(), 0u);
  EXPECT_EQ(surface_at(map, here).kind, Surface::Kind::none);
}

TEST(VoxelKey, TellsCellsApartAndRefusesWhatWouldAlias) {
  const double most = static_cast<double>(kMaxCell) - 0.5;
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(key_of(Vector3d::Constant(sign * (most - 1.0))));
    for (int axis = 0; axis < 3; ++axis) {
      for (const double bad : {sign * (most + 1.0), sign * 2.0 * most, sign * 1e30,
                               sign * std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
        Vector3d point(0.5, 0.5, 0.5);
        point[axis] = bad;
        EXPECT_FALSE(key_of(point)) << bad;
      }
    }
  }
  std::map<VoxelKey, Vector3d> seen;
  for (const double x : {-most + 1.0, -1.5, -0.5, 0.5, 1.5, most - 1.0})
    for (const double y : {-most + 1.0, -1.5, -0.5, 0.5, 1.5, most - 1.0})
      for (const double z : {-most + 1.0, -1.5, -0.5, 0.5, 1.5, most - 1.0})
        seen[*key_of({x, y, z})] = {x, y, z};
  EXPECT_EQ(seen.size(), 216u);
  EXPECT_EQ(key_of({0.0, 1.0, -1.0}), key_of({0.999, 1.5, -0.001}));
}

TEST(VoxelTable, DoesWhatAMapDoes) {
  std::mt19937 random(12);
  VoxelTable<int> table;
  std::map<VoxelKey, int> expected;
  std::vector<VoxelKey> order;
  std::uniform_int_distribution<std::int64_t> cell(-12, 12);
  for (int step = 0; step < 40'000; ++step) {
    const VoxelKey key = pack_cell(cell(random), cell(random), cell(random));
    if (step % 3 == 0) {
      const int* found = table.find(key);
      ASSERT_EQ(found != nullptr, expected.contains(key));
      if (found) {
        EXPECT_EQ(*found, expected[key]);
      }
    } else {
      const auto [value, is_new] = table.find_or_insert(key);
      ASSERT_EQ(is_new, !expected.contains(key));
      if (is_new) order.push_back(key);
      value = expected[key] = step;
    }
    if (step % 9'000 == 8'999) {
      table.retain([&](VoxelKey k) { return expected.at(k) % 3 == 1; });
      std::erase_if(expected, [](const auto& entry) { return entry.second % 3 != 1; });
      std::erase_if(order, [&](VoxelKey k) { return !expected.contains(k); });
    }
    ASSERT_EQ(table.size(), expected.size());
  }
  EXPECT_EQ(table.keys(), order);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(table.values()[i], expected[order[i]]);
  table.clear();
  EXPECT_EQ(table.size(), 0u);
  EXPECT_EQ(table.find(order[0]), nullptr);
}

TEST(VoxelFilter, KeepsOnePointOfEachVoxelInTheirOrder) {
  const auto position = [](const Vector3d& p) { return p; };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-5.0, 5.0);
  std::vector<Vector3d> points;
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  points.emplace_back(1e30, 0, 0);
  const auto voxel = [](const Vector3d& p) {
    return std::tuple(std::floor(p.x() / 2.0), std::floor(p.y() / 2.0), std::floor(p.z() / 2.0));
  };
  const std::vector<Vector3d> kept = voxel_filter(points, 2.0, position);
  std::set<std::tuple<double, double, double>> voxels;
  auto next = points.begin();
  for (const Vector3d& p : kept) {
    EXPECT_TRUE(voxels.insert(voxel(p)).second);
    next = std::find(next, points.end(), p);
    ASSERT_NE(next, points.end());
  }
  EXPECT_EQ(voxels.size(), 216u);
  EXPECT_EQ(voxel_filter(points, 0.0, position), points);
}

}  // namespace
}  // namespace lego_loam_sc
