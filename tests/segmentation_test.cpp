// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/segmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "made_scenes.hpp"
#include "segmentation/ground.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

struct Labelled {
  RangeImage image;
  Segmentation segmentation;
  Pose T_world_level;

  Vector3d world(std::size_t i) const { return T_world_level * image.points[i].cast<double>(); }
  bool ground(std::size_t i) const { return segmentation.label[i] == Label::ground; }

  // Share of the points for which `which(world position)` holds that are ground.
  template <class Which>
  double ground_share(Which&& which) const {
    int all = 0, marked = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
      if (!which(world(i))) continue;
      ++all;
      marked += ground(i);
    }
    EXPECT_GT(all, 50);
    return static_cast<double>(marked) / std::max(all, 1);
  }
};

Labelled label(const Scene& scene, const SensorModel& sensor, const Pose& T_world_lidar,
               double height, const SegmentationSettings& settings = {}) {
  const Scan scan = take_scan(scene, sensor, T_world_lidar, {.noise = 0.005, .seed = 1});
  Labelled result{project(scan, sensor), {}, T_world_lidar};
  result.T_world_level.linear() = T_world_lidar.linear() * R_base_lidar(sensor).transpose();
  result.segmentation = segment(result.image, sensor, height, settings);
  return result;
}

Scene floor_at_zero() {
  Scene scene;
  scene.plane({0, 0, 0}, Vector3d::UnitZ());
  return scene;
}

const auto on_the_floor = [](const Vector3d& p) { return std::abs(p.z()) < 0.1; };

TEST(Ground, AFlatFloorIsGround) {
  for (const double height : {0.0, kMadeHeight}) {
    const Labelled l = label(floor_at_zero(), made_sensor(), pose_of(0, 0, kMadeHeight), height);
    EXPECT_GT(l.ground_share(on_the_floor), 0.99);
    EXPECT_EQ(l.segmentation.ground_points + l.segmentation.segment_points, l.image.size());
  }
}

TEST(Ground, ATiltedMountIsTakenOut) {
  SensorModel sensor = made_sensor();
  sensor.mount_roll_deg = -8.0;
  sensor.mount_pitch_deg = 15.0;
  Pose at = pose_of(0, 0, kMadeHeight);
  at.linear() = rotation_from_rpy(radians(-8.0), radians(15.0), 0.0);
  const Labelled l = label(street(), sensor, at, kMadeHeight);
  EXPECT_GT(l.ground_share([](const Vector3d& p) {
    return std::abs(p.z()) < 0.03 && p.head<2>().norm() < 20.0;
  }),
            0.95);
  EXPECT_LT(l.ground_share([](const Vector3d& p) { return p.z() > 0.7; }), 0.02);

  sensor.mount_roll_deg = sensor.mount_pitch_deg = 0.0;  // not told of it, it finds less
  const Labelled untold = label(street(), sensor, at, kMadeHeight);
  EXPECT_LT(untold.ground_share(on_the_floor), 0.7);
}

TEST(Ground, ASensorUpsideDownFindsTheGroundAboveItself) {
  SensorModel sensor = made_sensor();
  sensor.mount_roll_deg = 180.0;
  Pose at = pose_of(0, 0, kMadeHeight);
  at.linear() = R_base_lidar(sensor);
  const Labelled l = label(street(), sensor, at, kMadeHeight);
  EXPECT_GT(l.ground_share([](const Vector3d& p) {
    return std::abs(p.z()) < 0.03 && p.head<2>().norm() < 20.0;
  }),
            0.95);
  EXPECT_LT(l.ground_share([](const Vector3d& p) { return p.z() > 0.7; }), 0.02);
}

TEST(Ground, AnEightDegreeSlopeUphillIsGround) {
  for (const double azimuth : {0.0, 50.0, 180.0}) {
    const Vector3d uphill(std::cos(radians(azimuth)), std::sin(radians(azimuth)), 0.0);
    Scene scene;
    scene.plane({0, 0, 0}, Vector3d::UnitZ() - std::tan(radians(8.0)) * uphill);
    const Labelled l = label(scene, made_sensor(), pose_of(0, 0, 1.6), 1.6);
    EXPECT_GT(l.ground_share([&](const Vector3d& p) { return uphill.dot(p) > 0.0 && p.z() < 1.5; }),
              0.95);
  }
}

TEST(Ground, ARampAheadOfTheVehicleIsGroundAndAWallIsNot) {
  Scene ramp = floor_at_zero();
  ramp.plane({6, 0, 0}, {-std::tan(radians(8.0)), 0, 1});
  const Labelled l = label(ramp, made_sensor(), pose_of(0, 0, kMadeHeight), kMadeHeight);
  EXPECT_GT(l.ground_share([](const Vector3d& p) { return p.x() > 8.0 && p.z() < 1.5; }), 0.9);
  Scene wall = floor_at_zero();
  wall.plane({6, 0, 0}, Vector3d::UnitX());
  const Labelled w = label(wall, made_sensor(), pose_of(0, 0, kMadeHeight), kMadeHeight);
  EXPECT_LT(w.ground_share([](const Vector3d& p) { return p.x() > 5.9 && p.z() > 0.5; }), 0.01);
}

// Share of ground on the upper or lower face of a box that the sensor sees.
double ground_on_a_box(double height, const Vector3d& low, const Vector3d& high, double face) {
  SegmentationSettings settings;
  settings.ground_max_elevation_deg = 15.0;
  Scene scene = floor_at_zero();
  scene.box(low, high);
  const Labelled l = label(scene, made_sensor(), pose_of(0, 0, height), height, settings);
  EXPECT_GT(l.ground_share(on_the_floor), 0.9);
  return l.ground_share([&](const Vector3d& p) { return std::abs(p.z() - face) < 0.03; });
}

TEST(Ground, ARoofAndATableAreNotGround) {
  EXPECT_EQ(ground_on_a_box(3.0, {4.5, -3, 0}, {14, 3, 1.5}, 1.5), 0.0);
  EXPECT_EQ(ground_on_a_box(1.8, {2.5, -3, 0.7}, {5, 3, 0.75}, 0.75), 0.0);
}

TEST(Ground, ACeilingIsNotGround) {
  EXPECT_EQ(ground_on_a_box(1.0, {4.5, -3, 2.4}, {14, 3, 2.5}, 2.4), 0.0);
}

TEST(Ground, TheMarkSurvivesAnEmptyPixel) {
  const SensorModel sensor = made_sensor();
  Scan scan = take_scan(floor_at_zero(), sensor, pose_of(0, 0, kMadeHeight));
  Scan holes;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    // Each hole lies between ground above and below it.
    if ((scan.ring[i] == 2 || scan.ring[i] == 4) && (i / 7) % 2 == 0) continue;
    holes.points.push_back(scan.points[i]);
    holes.ring.push_back(scan.ring[i]);
  }
  ASSERT_LT(holes.size(), scan.size() - 1000);
  const RangeImage image = project(holes, sensor);
  const Segmentation segmentation = segment(image, sensor, kMadeHeight, {});
  EXPECT_EQ(segmentation.ground_points, image.size());
}

TEST(Ground, TheHeightOfTheSensorIsThatOfTheFloorBelowIt) {
  const SensorModel sensor = made_sensor();
  for (const double height : {0.6, 1.73, 2.5}) {
    const RangeImage image =
        project(take_scan(street(), sensor, pose_of(0, 0, height), {.noise = 0.01}), sensor);
    const auto estimate = estimate_sensor_height(image, sensor, {});
    ASSERT_TRUE(estimate.has_value());
    EXPECT_NEAR(*estimate, height, 0.03);
  }
  Scene wall;
  wall.plane({5, 0, 0}, Vector3d::UnitX());
  EXPECT_FALSE(estimate_sensor_height(project(take_scan(wall, sensor, Pose::Identity()), sensor),
                                      sensor, {}));
}

// ---- Clusters.

struct Pixel {
  int row, column;
  double range;
};

Segmentation of_pixels(const std::vector<Pixel>& pixels, const SensorModel& sensor,
                       const SegmentationSettings& settings = {}) {
  Scan scan;
  for (const auto& [row, column, range] : pixels)
    scan.points.push_back(
        (range * beam(column_azimuth(sensor, column), radians(sensor.elevation_deg[row])))
            .cast<float>());
  return segment(project(scan, sensor), sensor, 0.0, settings);
}

// `count` pixels in `rows` rows that are one surface.
std::vector<Pixel> blob(int count, int rows, int first_row, int first_column, double range) {
  std::vector<Pixel> pixels;
  for (int i = 0; i < count; ++i)
    pixels.push_back({first_row + i % rows, (first_column + i / rows) % 1800, range});
  return pixels;
}

std::vector<Pixel> together(std::vector<Pixel> a, const std::vector<Pixel>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Clusters, TwoObjectsApartAreTwo) {
  const SensorModel sensor = made_sensor();
  // Side by side with a gap, and one behind the other.
  for (const auto& other : {blob(60, 3, 10, 700, 6.0), blob(60, 3, 10, 620, 9.0)}) {
    const Segmentation s = of_pixels(together(blob(60, 3, 10, 600, 6.0), other), sensor);
    EXPECT_EQ(s.clusters, 2);
    EXPECT_EQ(s.segment_points, 120u);
    EXPECT_EQ(std::set<std::int32_t>(s.cluster.begin(), s.cluster.end()),
              (std::set<std::int32_t>{0, 1}));
    EXPECT_EQ(std::count(s.cluster.begin(), s.cluster.end(), 0), 60);
  }
}

TEST(Clusters, OneObjectIsOne) {
  const Segmentation s = of_pixels(blob(600, 3, 10, 600, 6.0), made_sensor());
  EXPECT_EQ(s.clusters, 1);
}

TEST(Clusters, ASmallBlobIsDroppedAndALargeOneKept) {
  const SensorModel sensor = made_sensor();
  const Segmentation small = of_pixels(blob(29, 2, 10, 600, 6.0), sensor);
  EXPECT_EQ(small.clusters, 0);
  EXPECT_EQ(small.segment_points, 0u);
  EXPECT_EQ(small.cluster, std::vector<std::int32_t>(29, -1));
  EXPECT_EQ(of_pixels(blob(30, 2, 10, 600, 6.0), sensor).segment_points, 30u);
}

TEST(Clusters, AThinPoleIsKeptAndItsFirstRowCounts) {
  const SensorModel sensor = made_sensor();
  EXPECT_EQ(of_pixels(blob(5, 3, 10, 600, 6.0), sensor).segment_points, 5u);
  EXPECT_EQ(of_pixels(blob(5, 2, 10, 600, 6.0), sensor).segment_points, 0u);
  EXPECT_EQ(of_pixels(blob(4, 3, 10, 600, 6.0), sensor).segment_points, 0u);
}

TEST(Clusters, AnObjectStraightBehindIsOne) {
  const Segmentation s = of_pixels(blob(60, 2, 10, 1785, 6.0), made_sensor());
  EXPECT_EQ(s.clusters, 1);
  EXPECT_EQ(s.segment_points, 60u);
}

TEST(Clusters, NumbersAscendInTheOrderOfAppearance) {
  const SensorModel sensor = made_sensor();
  const Segmentation s =
      of_pixels(together(blob(40, 2, 13, 100, 6.0),
                         together(blob(40, 2, 9, 900, 8.0), blob(40, 2, 9, 1500, 7.0))),
                sensor);
  EXPECT_EQ(s.clusters, 3);
  std::int32_t highest = -1;
  for (const std::int32_t c : s.cluster) {
    EXPECT_LE(c, highest + 1);
    highest = std::max(highest, c);
  }
}

TEST(Segmentation, SwitchedOffItKeepsEveryPoint) {
  SegmentationSettings off;
  off.enabled = false;
  const Labelled l = label(street(), made_sensor(), pose_of(0, 0, kMadeHeight), kMadeHeight, off);
  EXPECT_EQ(l.segmentation.segment_points, l.image.size());
  EXPECT_EQ(l.segmentation.ground_points, 0u);
  EXPECT_EQ(std::count(l.segmentation.label.begin(), l.segmentation.label.end(), Label::segment),
            static_cast<std::ptrdiff_t>(l.image.size()));
}

TEST(Segmentation, NothingIsNothing) {
  const SensorModel sensor = made_sensor();
  const Segmentation s = segment(project({}, sensor), sensor, 0.0, {});
  EXPECT_EQ(s.clusters, 0);
  EXPECT_TRUE(s.label.empty());
}

}  // namespace
}  // namespace lego_loam_sc
