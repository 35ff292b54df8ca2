// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/city_route.hpp"
#include "sim/drive.hpp"
#include "sim/places.hpp"
#include "sim/ray_caster.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::int64_t second = 1'000'000'000;
constexpr double drift = 0.8;  // m by which the route's heights grow from lap to lap

// Once and a half round a block, 240 m.
Trajectory short_route() {
  const std::vector<Vector2d> corners = {{20, 0}, {50, 0}, {50, 45}, {0, 45},
                                         {0, 0},  {50, 0}, {50, 40}};
  DriveSettings settings;
  settings.speed = 9.0;
  settings.acceleration = 2.0;
  settings.lateral_acceleration = 2.5;
  const Drive drive(Route(corners, 9.0), [](double, double) { return 0.0; }, settings);
  Trajectory route;
  for (std::int64_t t = 0; t <= drive.duration_ns(); t += second / 10) {
    Pose pose = drive.pose(t);
    pose.translation().z() =
        0.05 * pose.translation().x() +
        drift * static_cast<double>(t) / static_cast<double>(drive.duration_ns());
    route.push_back({t, pose});
  }
  return route;
}

const World& city() {
  static const World world = make_city(1, short_route());
  return world;
}

TEST(SimCity, MovesAsTheRouteDoesWithoutJumps) {
  const Motion& motion = city().motion;
  const Trajectory route = short_route();
  EXPECT_EQ(motion.duration_ns, route.back().stamp_ns);
  for (const StampedPose& stamped : route)
    EXPECT_LT(
        (motion.pose(stamped.stamp_ns).translation() - stamped.pose.translation()).head<2>().norm(),
        0.3);
  const std::int64_t step = 1'000'000;
  Vector6 before = log_se3(motion.pose(0).inverse() * motion.pose(step));
  for (std::int64_t t = step; t < motion.duration_ns; t += step) {
    const Vector6 twist = log_se3(motion.pose(t).inverse() * motion.pose(t + step));
    EXPECT_LT((twist - before).head<3>().norm(), 2e-5) << "at " << t;  // 20 m/s^2
    EXPECT_LT((twist - before).tail<3>().norm(), 5e-6) << "at " << t;  // 5 rad/s^2
    before = twist;
  }
}

TEST(SimCity, APlaceHasOneHeightHoweverOftenItIsPassed) {
  const Motion& motion = city().motion;
  int revisits = 0;
  for (std::int64_t t = 0; t < motion.duration_ns; t += second / 4) {
    for (std::int64_t u = t + 15 * second; u < motion.duration_ns; u += second / 10) {
      const Vector3d apart = motion.pose(u).translation() - motion.pose(t).translation();
      if (apart.head<2>().norm() > 0.5) continue;
      ++revisits;
      EXPECT_NEAR(apart.z(), 0.0, 0.08);  // the slope over half a metre, and the shaking
    }
  }
  EXPECT_GT(revisits, 20);
}

TEST(SimCity, LeavesTheVehicleRoomOnFirmGround) {
  const RayCaster caster(city().mesh);
  const Motion& motion = city().motion;
  for (std::int64_t t = 0; t < motion.duration_ns; t += second / 5) {
    const Pose pose = motion.pose(t);
    const auto ground = caster.cast(pose * Vector3d(0, 0, 1.73), -pose.linear().col(2), 10.0);
    ASSERT_TRUE(ground) << "at " << t;
    EXPECT_NEAR(ground->range, 1.73, 0.06) << "at " << t;
    for (int deg = 0; deg < 360; deg += 5) {
      const Vector3d along(std::cos(radians(deg)), std::sin(radians(deg)), 0.0);
      for (const double height : {0.5, 1.73})
        EXPECT_FALSE(caster.cast(pose * Vector3d(0, 0, height), pose.linear() * along, 1.4))
            << "an obstacle at " << t << ", " << deg << " deg";
    }
  }
}

TEST(SimCity, HasStructureOnAllSides) {
  const RayCaster caster(city().mesh);
  const Motion& motion = city().motion;
  for (std::int64_t t = 0; t < motion.duration_ns; t += 2 * second) {
    const Pose pose = motion.pose(t);
    for (int side = 0; side < 4; ++side) {
      int walls = 0;
      for (int deg = -45; deg < 45; ++deg) {
        const double azimuth = radians(90.0 * side + deg);
        walls +=
            caster
                .cast(pose * Vector3d(0, 0, 1.73),
                      pose.linear() * Vector3d(std::cos(azimuth), std::sin(azimuth), 0.02), 80.0)
                .has_value();
      }
      EXPECT_GT(walls, 20) << "at " << t << ", side " << side;
    }
  }
}

TEST(SimCity, TrafficTouchesNeitherTheVehicleNorWhatStandsStill) {
  const World& world = city();
  const RayCaster caster(world.mesh);
  ASSERT_GT(world.traffic.movers.size(), 2u);
  for (const Mover& mover : world.traffic.movers) {
    for (std::int64_t t = mover.from_ns; t <= mover.to_ns; t += second / 10) {
      const Pose T_vehicle_mover = world.motion.pose(t).inverse() * mover.pose(t);
      Eigen::AlignedBox3d box;
      for (const Eigen::Vector3f& v : world.traffic.models[mover.model].vertices)
        box.extend(T_vehicle_mover * v.cast<double>());
      // Of two turned boxes that meet one has a corner within the other's outline.
      const Eigen::AlignedBox3d vehicle(Vector3d(-2.2, -0.9, 0.2), Vector3d(2.2, 0.9, 1.5));
      EXPECT_FALSE(box.intersects(vehicle)) << "model " << mover.model << " at " << t;
      const Pose pose = mover.pose(t);
      for (const double height : {0.6, 1.2}) {
        for (const double side : {-1.0, 1.0}) {
          EXPECT_FALSE(caster.cast(pose * Vector3d(0, 0, height), side * pose.linear().col(0), 0.3))
              << "model " << mover.model << " at " << t;
        }
      }
    }
  }
}

TEST(SimCity, IsDecidedByItsSeed) {
  const World again = make_city(1, short_route());
  EXPECT_EQ(city().mesh.vertices, again.mesh.vertices);
  EXPECT_EQ(city().mesh.triangles, again.mesh.triangles);
  EXPECT_EQ(city().mesh.reflectivity, again.mesh.reflectivity);
  EXPECT_TRUE(city().motion.pose(second).isApprox(again.motion.pose(second), 0.0));
  ASSERT_EQ(city().traffic.movers.size(), again.traffic.movers.size());
  EXPECT_NE(city().mesh.vertices, make_city(2, short_route()).mesh.vertices);
}

TEST(SimCityRoute, IsAsLongAsTheDriveThatItStandsFor) {
  const Trajectory route = make_city_route();
  double length = 0.0, fastest = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) {
    const double step = (route[i].pose.translation() - route[i - 1].pose.translation()).norm();
    length += step;
    fastest = std::max(fastest, step / 0.1);
  }
  EXPECT_NEAR(length, 3724.0, 40.0);
  EXPECT_NEAR(static_cast<double>(route.size()), 4541.0, 60.0);
  EXPECT_LT(fastest, 12.5);
  EXPECT_LT((route.back().pose.translation() - route.front().pose.translation()).norm(), 30.0);
}

TEST(SimCityRoute, ComesBackInBothDirections) {
  const Trajectory route = make_city_route();
  int same = 0, opposite = 0;
  for (std::size_t i = 0; i < route.size(); i += 10) {
    bool met_same = false, met_opposite = false;
    for (std::size_t j = 0; j + 300 < i; j += 5) {
      const Pose between = route[j].pose.inverse() * route[i].pose;
      if (between.translation().norm() > 4.0) continue;
      met_same |= rotation_angle(between) < 0.3;
      met_opposite |= rotation_angle(between) > 2.8;
    }
    same += met_same;
    opposite += met_opposite;
  }
  EXPECT_GT(same, 50);  // of 454
  EXPECT_GT(opposite, 15);
}

}  // namespace
}  // namespace lego_loam_sc
