// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "path_length.hpp"
#include "sim/lidar.hpp"
#include "sim/ray_caster.hpp"
#include "sim/world.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

double return_error(const Motion& motion) {
  const Pose change = motion.pose(0).inverse() * motion.pose(motion.duration_ns);
  return change.translation().norm() + rotation_angle(change);
}

SensorModel sixteen_beams() {
  SensorModel sensor;
  for (int i = 0; i < 16; ++i) sensor.elevation_deg.push_back(-15.0 + 2.0 * i);
  return sensor;
}

Vector3d direction_of(double azimuth_deg, double elevation_deg) {
  return rotation_from_rpy(0.0, -radians(elevation_deg), radians(azimuth_deg)).col(0);
}

// The pitch of the way itself, rad: over four seconds the shaking averages out.
double slope(const Motion& motion, std::int64_t time) {
  const Vector3d step =
      motion.pose(time + 4 * second).translation() - motion.pose(time).translation();
  return std::atan2(step.z(), step.head<2>().norm());
}

TEST(SimParking1, IsDrivenOnceRoundBackToItsStart) {
  const Motion motion = make_world("parking1", 1).motion;
  EXPECT_NEAR(path_length(motion), 182.0, 2.5);
  EXPECT_LT(return_error(motion), 1e-9);
}

TEST(SimParking2, IsDrivenDownAndUpBackToItsStart) {
  const Motion motion = make_world("parking2", 1).motion;
  EXPECT_NEAR(path_length(motion), 197.0, 2.5);
  EXPECT_LT(return_error(motion), 1e-9);
  double lowest = 0.0, steepest = 0.0;
  for (std::int64_t t = 0; t < motion.duration_ns; t += second) {
    const Vector3d place = motion.pose(t).translation();
    lowest = std::min(lowest, place.z());
    if (place.y() < -1.0)  // on the ramps, where there are no bumps
      steepest = std::max(steepest, std::abs(slope(motion, t)));
  }
  EXPECT_NEAR(lowest, -3.2, 0.1);
  EXPECT_NEAR(degrees(steepest), 6.5, 1.0);
}

// A place in an aisle of the upper storey; the same below is 3.2 m lower.
const Vector3d kInTheAisle(33.0, 8.4, 0.9), kBelow(0.0, 0.0, -3.2);

TEST(SimParking2, TheSameAisleIsDrivenOnBothStoreys) {
  const Motion motion = make_world("parking2", 1).motion;
  std::vector<Pose> above, below;
  for (std::int64_t t = 0; t < motion.duration_ns; t += second / 10) {
    const Pose pose = motion.pose(t);
    const Vector3d offset = pose.translation() - kInTheAisle;
    if (offset.head<2>().norm() > 0.1) continue;
    (offset.z() > -2.0 ? above : below).push_back(pose);
  }
  ASSERT_FALSE(above.empty());
  ASSERT_FALSE(below.empty());
  const Pose between = above.front().inverse() * below.front();
  EXPECT_LT((between.translation() - kBelow).norm(), 0.3);
  EXPECT_LT(rotation_angle(between), radians(3.0));
}

TEST(SimParking2, TheStoreysAreAlikeButForTheCars) {
  const RayCaster caster(make_world("parking2", 1).mesh);
  const auto agreement = [&](double elevation_deg) {
    int same = 0, rays = 0;
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 0.5, ++rays) {
      const Vector3d direction = direction_of(azimuth, elevation_deg);
      const auto above = caster.cast(kInTheAisle, direction, 100.0);
      const auto below = caster.cast(kInTheAisle + kBelow, direction, 100.0);
      same += above && below && std::abs(above->range - below->range) < 1e-3;
    }
    return static_cast<double>(same) / rays;
  };
  EXPECT_EQ(agreement(25.0), 1.0);  // the roof with its beams and pipes
  EXPECT_GT(agreement(6.0), 0.5);   // columns and walls
  EXPECT_LT(agreement(-3.0), 0.8);  // the cars
}

TEST(SimParking2, TheDriveDependsOnTheSeedOnlyByItsShaking) {
  const Motion first = make_world("parking2", 1).motion, other = make_world("parking2", 2).motion;
  EXPECT_EQ(first.duration_ns, other.duration_ns);
  for (std::int64_t t = 0; t < first.duration_ns; t += second)
    EXPECT_LT((first.pose(t).translation() - other.pose(t).translation()).norm(), 0.06);
}

TEST(SimMine, IsDrivenOnceRoundAndOnOverItsFirstRoadway) {
  const Motion motion = make_world("mine", 1).motion;
  EXPECT_NEAR(path_length(motion), 636.0, 5.0);
  const Pose end = motion.pose(motion.duration_ns);
  double nearest = 1e9, travelled = 0.0;
  Pose there;
  for (std::int64_t t = 0; t < 40 * second; t += second / 20) {
    const Pose pose = motion.pose(t);
    const double distance = (pose.translation() - end.translation()).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    there = pose;
    travelled = (pose.translation() - motion.pose(0).translation()).norm();
  }
  EXPECT_NEAR(travelled, 40.0, 1.0);
  const Pose between = there.inverse() * end;
  EXPECT_LT(between.translation().norm(), 0.15);
  EXPECT_LT(rotation_angle(between), radians(4.0));
}

TEST(SimMine, RisesAndFallsByAFewDegrees) {
  const Motion motion = make_world("mine", 1).motion;
  double steepest = 0.0, flattest = 0.0;
  for (std::int64_t t = 5 * second; t < motion.duration_ns - 5 * second; t += second) {
    steepest = std::max(steepest, slope(motion, t));
    flattest = std::min(flattest, slope(motion, t));
  }
  EXPECT_NEAR(degrees(steepest), 5.0, 1.5);
  EXPECT_NEAR(degrees(flattest), -5.0, 1.5);
}

TEST(SimMine, HasCrossCutsAndDeadEnds) {
  const RayCaster caster(make_world("mine", 1).mesh);
  // From the middle of the loop's first roadway at x = 40 a cross-cut leads to the left, at x = 80
  // a dead end to the right; at x = 60 there is rock on both sides.
  const auto sight = [&](const Vector3d& floor, double azimuth_deg) {
    const auto hit =
        caster.cast(floor + Vector3d(0, 0, 2.6), direction_of(azimuth_deg, 0.0), 150.0);
    return hit ? hit->range : 150.0;
  };
  const auto floor_at = [&](double x, double y) -> Vector3d {
    const auto hit = caster.cast({x, y, 7.0}, -Vector3d::UnitZ(), 10.0);
    return {x, y, hit ? 7.0 - hit->range : 0.0};
  };
  const auto way = [&](double x, double y) { return floor_at(x, y); };
  EXPECT_GT(sight(way(40, 1.7), 91.0), 8.0);
  EXPECT_GT(sight(way(80, 2.3), -83.0), 8.0);
  EXPECT_LT(sight(way(60, 2.6), 90.0), 3.5);
  EXPECT_LT(sight(way(60, 2.6), -90.0), 3.5);
}

class SimUnderground : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, SimUnderground, testing::Values("parking2", "mine"),
                         [](const auto& name) { return std::string(name.param); });

// A gap between two surfaces would let rays escape.
TEST_P(SimUnderground, IsClosedAllRound) {
  const World world = make_world(GetParam(), 1);
  const RayCaster caster(world.mesh);
  int escaped = 0;
  for (std::int64_t t = 0; t < world.motion.duration_ns; t += 4 * second) {
    const Pose pose = world.motion.pose(t);
    const Vector3d sensor = pose * Vector3d(0, 0, world.sensor_height);
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 3.0)
      for (double elevation = -60.0; elevation <= 60.0; elevation += 4.0)
        escaped += !caster.cast(sensor, pose.linear() * direction_of(azimuth, elevation), 300.0);
  }
  EXPECT_EQ(escaped, 0);
}

class SimTunnel : public testing::Test {
 protected:
  // A scan without noise from the middle of the bore.
  Scan scan_at(double x) const {
    const auto pose = [x](std::int64_t) -> Pose { return Pose(Eigen::Translation3d(x, 0.1, 1.2)); };
    return sweep(caster_, sixteen_beams(), pose, 0,
                 {.distort = false, .noise = 0.0, .drop_outs = false});
  }

  const World world_ = make_world("tunnel", 1);
  const RayCaster caster_{world_.mesh};
};

// Up to the rounding of the bore's single-precision vertices.
TEST_F(SimTunnel, LooksTheSameFromEverywhereBehindTheNiches) {
  const Scan first = scan_at(170.0);
  for (const double x : {201.0, 263.7, 315.0}) {
    const Scan other = scan_at(x);
    ASSERT_EQ(first.size(), other.size());
    for (std::size_t i = 0; i < first.size(); ++i)
      ASSERT_LT((first.points[i] - other.points[i]).norm(), 1e-4f) << "from " << x;
  }
}

TEST_F(SimTunnel, NichesAreSeenFromTheStartAndHardlyFromThirtyMetresFurther) {
  const Scan bare = scan_at(250.0);
  const auto changed = [&](double x) {
    const Scan scan = scan_at(x);
    std::size_t count = 0;
    for (const Eigen::Vector3f& p : scan.points) count += std::abs(p.y() + 0.1f) > 2.65f;
    return static_cast<double>(count) / static_cast<double>(bare.size());
  };
  EXPECT_GT(changed(2.0), 0.05);
  EXPECT_LT(changed(45.0), 0.002);
}

TEST_F(SimTunnel, IsDrivenStraightAtConstantSpeed) {
  const Motion& motion = world_.motion;
  EXPECT_NEAR((motion.pose(motion.duration_ns).translation() - motion.pose(0).translation()).norm(),
              315.0, 1e-9);
  for (std::int64_t t = 0; t < motion.duration_ns - second; t += second) {
    const Vector3d here = motion.pose(t).translation();
    if (here.x() < 10.0 || here.x() > 308.0) continue;
    EXPECT_NEAR(motion.pose(t + second).translation().x() - here.x(), 2.0, 1e-6);
    EXPECT_NEAR(here.y(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace lego_loam_sc
