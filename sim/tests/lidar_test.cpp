// SPDX-License-Identifier: BSD-3-Clause
#include "sim/lidar.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

const Vector3d room_low(-6.0, -5.0, 0.0);
const Vector3d room_high(9.0, 4.0, 3.0);

Mesh room(double reflectivity = 0.5) {
  Mesh mesh;
  const Vector3d size = room_high - room_low;
  Pose pose = Pose::Identity();
  pose.translation() = 0.5 * (room_low + room_high);
  pose.translation().z() = room_low.z();
  add_box(mesh, pose, size, reflectivity);
  return mesh;
}

// Distance from inside the room to its walls.
double distance_to_wall(const Vector3d& from, const Vector3d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double wall = direction[axis] > 0.0 ? room_high[axis] : room_low[axis];
    nearest = std::min(nearest, (wall - from[axis]) / direction[axis]);
  }
  return nearest;
}

// Distance of a point to the nearest wall's plane.
double off_the_wall(const Vector3d& point) {
  return std::min((point - room_low).cwiseAbs().minCoeff(),
                  (point - room_high).cwiseAbs().minCoeff());
}

SensorModel sixteen_beams() {
  SensorModel sensor;
  for (int i = 0; i < 16; ++i) sensor.elevation_deg.push_back(-15.0 + 2.0 * i);
  sensor.min_range = 0.5;
  return sensor;
}

LidarSettings perfect() {
  return {.distort = false, .noise = 0.0, .drop_outs = false, .seed = 1};
}

LidarPose standing() {
  return [](std::int64_t) {
    Pose pose = Pose::Identity();
    pose.translation() = Vector3d(0.5, 0.3, 1.2);
    pose.linear() = rotation_from_rpy(0.02, -0.03, 0.4);
    return pose;
  };
}

// 2 m/s forward and 1.5 rad/s to the left.
Pose moving(std::int64_t time_ns) {
  const double t = static_cast<double>(time_ns) * 1e-9;
  Pose pose = Pose::Identity();
  pose.translation() = Vector3d(2.0 * t, 0.3, 1.2);
  pose.linear() = rotation_from_rpy(0.0, 0.0, 1.5 * t);
  return pose;
}

bool same(const Scan& a, const Scan& b) {
  return a.points == b.points && a.intensity == b.intensity && a.ring == b.ring &&
         a.offset_ns == b.offset_ns;
}

TEST(SimLidar, RangesInARoomAgreeWithTheClosedForm) {
  const RayCaster world(room());
  const SensorModel sensor = sixteen_beams();
  const Scan scan = sweep(world, sensor, standing(), 0, perfect());
  ASSERT_EQ(scan.size(), 16u * 1800u);
  const Pose T_world_lidar = standing()(0);
  for (const Eigen::Vector3f& p : scan.points) {
    const Vector3d point = p.cast<double>();
    const Vector3d direction = T_world_lidar.linear() * point.normalized();
    EXPECT_NEAR(point.norm(), distance_to_wall(T_world_lidar.translation(), direction), 1e-4);
  }
}

TEST(SimLidar, BeamsHaveTheElevationsOfTheModel) {
  const SensorModel sensor = sixteen_beams();
  const Scan scan = sweep(RayCaster(room()), sensor, standing(), 0, perfect());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    EXPECT_NEAR(degrees(std::atan2(p.z(), p.head<2>().norm())), sensor.elevation_deg[scan.ring[i]],
                1e-4);
  }
}

TEST(SimLidar, ADistortedPointLiesOnTheWallFromThePoseOfItsFiringTime) {
  const std::int64_t stamp = 300'000'000;
  LidarSettings settings = perfect();
  settings.distort = true;
  const Scan scan = sweep(RayCaster(room()), sixteen_beams(), moving, stamp, settings);
  ASSERT_EQ(scan.offset_ns.size(), scan.size());
  double worst_from_stamp = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vector3d point = scan.points[i].cast<double>();
    EXPECT_LT(off_the_wall(moving(stamp + scan.offset_ns[i]) * point), 1e-5);
    worst_from_stamp = std::max(worst_from_stamp, off_the_wall(moving(stamp) * point));
  }
  EXPECT_GT(worst_from_stamp, 0.1);  // the motion within the sweep is visible
}

TEST(SimLidar, WithoutDistortionAllPointsAreSeenFromTheStamp) {
  const std::int64_t stamp = 300'000'000;
  const Scan scan = sweep(RayCaster(room()), sixteen_beams(), moving, stamp, perfect());
  EXPECT_TRUE(scan.offset_ns.empty());
  for (const Eigen::Vector3f& p : scan.points)
    EXPECT_LT(off_the_wall(moving(stamp) * p.cast<double>()), 1e-5);
}

TEST(SimLidar, ASweepTurnsAsTheModelSays) {
  for (const bool clockwise : {true, false}) {
    SensorModel sensor = sixteen_beams();
    sensor.clockwise = clockwise;
    sensor.start_azimuth_deg = 90.0;
    LidarSettings settings = perfect();
    settings.distort = true;
    const Scan scan = sweep(RayCaster(room()), sensor, standing(), 0, settings);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const double turned = 360.0 * scan.offset_ns[i] * 1e-9 / sensor.period;
      const double expected = radians(90.0 + (clockwise ? -turned : turned));
      const Eigen::Vector2f direction = scan.points[i].head<2>().normalized();
      EXPECT_NEAR(direction.x(), std::cos(expected), 1e-6);
      EXPECT_NEAR(direction.y(), std::sin(expected), 1e-6);
    }
  }
}

TEST(SimLidar, PointsAreStoredAsKittiDoes) {
  const Scan scan = sweep(RayCaster(room()), sixteen_beams(), standing(), 0, perfect());
  std::uint16_t row = 15;
  double previous = -1.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    double azimuth = degrees(std::atan2(p.y(), p.x()));
    if (azimuth < 0.0) azimuth += 360.0;
    if (azimuth <= previous) {  // the next ring starts where the azimuth passes straight ahead
      EXPECT_GT(previous, 270.0);
      EXPECT_LT(azimuth, 90.0);
      --row;
    }
    EXPECT_EQ(scan.ring[i], row);
    previous = azimuth;
  }
  EXPECT_EQ(row, 0);
}

TEST(SimLidar, RangeNoiseHasTheAskedForSigmaAndNoBias) {
  const RayCaster world(room());
  const Scan exact = sweep(world, sixteen_beams(), standing(), 0, perfect());
  LidarSettings settings = perfect();
  settings.noise = 0.03;
  const Scan noisy = sweep(world, sixteen_beams(), standing(), 0, settings);
  ASSERT_EQ(noisy.size(), exact.size());
  double sum = 0.0, sum_of_squares = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double error = noisy.points[i].norm() - exact.points[i].norm();
    sum += error;
    sum_of_squares += error * error;
  }
  const auto n = static_cast<double>(exact.size());
  EXPECT_NEAR(sum / n, 0.0, 0.001);
  EXPECT_NEAR(std::sqrt(sum_of_squares / n), 0.03, 0.0006);
}

TEST(SimLidar, DarkWallsLoseMoreEchoesThanBrightOnes) {
  LidarSettings settings = perfect();
  settings.drop_outs = true;
  const auto echoes = [&](double reflectivity) {
    return sweep(RayCaster(room(reflectivity)), sixteen_beams(), standing(), 0, settings).size();
  };
  EXPECT_LT(echoes(0.002), echoes(0.02));
  EXPECT_LT(echoes(0.02), 16u * 1800u);
}

TEST(SimLidar, GrazingRaysLoseMoreEchoesThanSteepOnes) {
  Mesh floor;
  add_quad(floor,
           {Vector3d(-99, -99, 0), Vector3d(99, -99, 0), Vector3d(99, 99, 0), Vector3d(-99, 99, 0)},
           0.2);
  LidarSettings settings = perfect();
  settings.drop_outs = true;
  const Scan scan = sweep(RayCaster(floor), sixteen_beams(), standing(), 0, settings);
  std::vector<int> echoes(16, 0);
  for (const std::uint16_t ring : scan.ring) ++echoes[ring];
  EXPECT_GT(echoes[0], 1790);
  EXPECT_LT(echoes[6], 1400);
  EXPECT_LT(echoes[7], echoes[6] / 2);
}

TEST(SimLidar, NothingNearerThanTheMinimumOrFartherThanTheMaximumReturns) {
  SensorModel sensor = sixteen_beams();
  sensor.min_range = 5.0;
  sensor.max_range = 7.0;
  LidarSettings settings = perfect();
  settings.noise = 0.1;
  const Scan scan = sweep(RayCaster(room()), sensor, standing(), 0, settings);
  ASSERT_GT(scan.size(), 1000u);
  for (const Eigen::Vector3f& p : scan.points) {
    EXPECT_GT(p.norm(), 5.0f - 1e-5f);
    EXPECT_LT(p.norm(), 7.0f + 1e-5f);
  }
}

TEST(SimLidar, IntensityIsReflectivityTimesTheCosineOfTheIncidence) {
  const Scan scan = sweep(RayCaster(room(0.6)), sixteen_beams(), standing(), 0, perfect());
  const Pose T_world_lidar = standing()(0);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vector3d direction = T_world_lidar.linear() * scan.points[i].cast<double>().normalized();
    const Vector3d hit = T_world_lidar * scan.points[i].cast<double>();
    int axis = 0;
    (hit - room_low).cwiseMin(room_high - hit).cwiseAbs().minCoeff(&axis);
    EXPECT_NEAR(scan.intensity[i], 0.6 * std::abs(direction[axis]), 1e-4);
  }
}

TEST(SimLidar, TheElevationCorrectionOfTheModelPutsPointsBackOnTheWalls) {
  SensorModel sensor = sixteen_beams();
  sensor.elevation_correction_deg = 0.5;
  const Scan scan = sweep(RayCaster(room()), sensor, standing(), 0, perfect());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vector3d p = scan.points[i].cast<double>();
    const double elevation = std::asin(p.z() / p.norm()) + radians(0.5);
    const Vector3d flat = Vector3d(p.x(), p.y(), 0.0).normalized();
    const Vector3d corrected =
        p.norm() * (std::cos(elevation) * flat + std::sin(elevation) * Vector3d::UnitZ());
    EXPECT_LT(off_the_wall(standing()(0) * corrected), 1e-5);
  }
}

TEST(SimLidar, TheSameSeedGivesTheSameBytesAtAnyNumberOfThreads) {
  const RayCaster world(room(0.02));
  LidarSettings settings{.distort = true, .noise = 0.02, .drop_outs = true, .seed = 7};
  const auto with_threads = [&](int threads) {
    Scan scan;
    tbb::task_arena(threads).execute(
        [&] { scan = sweep(world, sixteen_beams(), moving, 100'000'000, settings); });
    return scan;
  };
  const Scan scan = with_threads(1);
  EXPECT_TRUE(same(scan, with_threads(2)));
  EXPECT_TRUE(same(scan, with_threads(4)));
  settings.seed = 8;
  EXPECT_FALSE(same(scan, with_threads(1)));
}

TEST(SimLidar, TheNoiseOfTwoScansDiffers) {
  const RayCaster world(room());
  LidarSettings settings = perfect();
  settings.noise = 0.02;
  const Scan first = sweep(world, sixteen_beams(), standing(), 0, settings);
  const Scan second = sweep(world, sixteen_beams(), standing(), 100'000'000, settings);
  EXPECT_NE(first.points, second.points);
}

TEST(SimLidar, TheMountingPrefersTheHeightThatTheSensorStates) {
  SensorModel sensor = sixteen_beams();
  EXPECT_DOUBLE_EQ(mounting(sensor, 0.9).translation().z(), 0.9);
  sensor.height = 1.5;
  sensor.mount_pitch_deg = 20.0;
  const Pose T_vehicle_lidar = mounting(sensor, 0.9);
  EXPECT_DOUBLE_EQ(T_vehicle_lidar.translation().z(), 1.5);
  const Vector3d forward = T_vehicle_lidar.linear() * Vector3d::UnitX();
  EXPECT_NEAR(forward.z(), -std::sin(radians(20.0)), 1e-12);  // positive pitch looks down
}

}  // namespace
}  // namespace lego_loam_sc
