// SPDX-License-Identifier: BSD-3-Clause
#include "sim/traffic.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "sim/lidar.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t second = 1'000'000'000;
const Vector3d size(4.0, 2.0, 1.5);

// A box that drives to the left 8 m ahead at 15 m/s, straight ahead at 0 s, turning slowly.
Pose driving(std::int64_t time_ns) {
  const double t = static_cast<double>(time_ns) * 1e-9;
  Pose pose = Pose::Identity();
  pose.translation() = Vector3d(8.0, 15.0 * t, 0.0);
  pose.linear() = rotation_from_rpy(0.0, 0.0, 1.5 + 0.5 * t);
  return pose;
}

TrafficPlan one_box(std::int64_t from_ns, std::int64_t to_ns) {
  TrafficPlan plan;
  plan.models.emplace_back();
  add_box(plan.models.front(), Pose::Identity(), size, 0.5);
  plan.movers.push_back({0, from_ns, to_ns, driving});
  return plan;
}

SensorModel sixteen_beams() {
  SensorModel sensor;
  for (int i = 0; i < 16; ++i) sensor.elevation_deg.push_back(-15.0 + 2.0 * i);
  sensor.start_azimuth_deg = 40.0;
  return sensor;
}

Pose standing(std::int64_t) {
  return Pose(Eigen::Translation3d(0.0, 0.0, 1.0));
}

Scan scan_of(const Traffic& traffic, const Mesh& still, bool distort) {
  return sweep(RayCaster(still), sixteen_beams(), standing, 0,
               {.distort = distort, .drop_outs = false}, traffic);
}

// Distance of a point to the surface of the box in its own frame.
double off_the_box(const Vector3d& point) {
  const Vector3d centred = point - Vector3d(0.0, 0.0, 0.5 * size.z());
  return std::abs((centred.cwiseAbs() - 0.5 * size).maxCoeff());
}

TEST(SimTraffic, AMovingBoxIsSeenWhereItIsAtTheFiringTime) {
  const Scan scan = scan_of(Traffic(one_box(-second, second)), {}, true);
  ASSERT_GT(scan.size(), 500u);
  double worst_from_stamp = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vector3d point = standing(0) * scan.points[i].cast<double>();
    EXPECT_LT(off_the_box(driving(scan.offset_ns[i]).inverse() * point), 1e-5);
    worst_from_stamp = std::max(worst_from_stamp, off_the_box(driving(0).inverse() * point));
  }
  EXPECT_GT(worst_from_stamp, 0.05);  // it moved before its last column
}

TEST(SimTraffic, MovesDuringTheSweepOfAScanWithoutDistortionToo) {
  const Traffic traffic(one_box(-second, second));
  EXPECT_EQ(scan_of(traffic, {}, false).points, scan_of(traffic, {}, true).points);
}

TEST(SimTraffic, IsThereOnlyInItsTime) {
  EXPECT_EQ(scan_of(Traffic(one_box(second, 2 * second)), {}, true).size(), 0u);
  EXPECT_EQ(scan_of(Traffic(one_box(-second, -1)), {}, true).size(), 0u);
  const std::int64_t leaves = 6'000'000;
  for (const std::int32_t offset : scan_of(Traffic(one_box(-1, leaves)), {}, true).offset_ns)
    EXPECT_LE(offset, leaves);
}

TEST(SimTraffic, TheNearerOfWorldAndTrafficIsSeen) {
  const auto wall_at = [](double x) {
    Mesh wall;
    add_quad(wall,
             {Vector3d(x, -50, -9), Vector3d(x, 50, -9), Vector3d(x, 50, 9), Vector3d(x, -50, 9)},
             0.5);
    return wall;
  };
  const Traffic traffic(one_box(-second, second)), nobody;
  EXPECT_EQ(scan_of(traffic, wall_at(4.0), true).points,
            scan_of(nobody, wall_at(4.0), true).points);
  const Scan behind = scan_of(traffic, wall_at(30.0), true);
  std::size_t on_box = 0;
  for (const Eigen::Vector3f& point : behind.points) on_box += point.x() < 15.0f;
  EXPECT_EQ(on_box, scan_of(traffic, {}, true).size());
  EXPECT_EQ(behind.size(), scan_of(nobody, wall_at(30.0), true).size());
}

TEST(SimTraffic, OnlyWhatARayCanReachIsNear) {
  const Traffic traffic(one_box(-second, 3 * second));
  EXPECT_EQ(traffic.near(Vector3d::Zero(), 10.0, 0, second / 10).size(), 1u);
  EXPECT_EQ(traffic.near(Vector3d(-50.0, 0.0, 0.0), 10.0, 0, second / 10).size(), 0u);
  EXPECT_EQ(traffic.near(Vector3d::Zero(), 10.0, 4 * second, second / 10).size(), 0u);
}

TEST(SimTraffic, LooksTheSameAtAnyNumberOfThreads) {
  const Traffic traffic(one_box(-second, second));
  const auto with_threads = [&](int threads) {
    Scan scan;
    tbb::task_arena(threads).execute([&] { scan = scan_of(traffic, {}, true); });
    return scan;
  };
  const Scan one = with_threads(1), two = with_threads(2);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.offset_ns, two.offset_ns);
}

}  // namespace
}  // namespace lego_loam_sc
