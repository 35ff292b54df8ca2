// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "path_length.hpp"
#include "sim/ray_caster.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

class SimWorld : public testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(All, SimWorld, testing::Values("parking", "street"),
                         [](const auto& name) { return std::string(name.param); });

TEST_P(SimWorld, HasStructureOnAllSidesOfTheVehicle) {
  World world = make_world(GetParam(), 1);
  const RayCaster caster(std::move(world.mesh));
  for (std::int64_t t = 0; t < world.motion.duration_ns; t += 5 * second) {
    const Pose pose = world.motion.pose(t);
    const Vector3d sensor = pose * Vector3d(0, 0, world.sensor_height);
    for (int side = 0; side < 4; ++side) {
      int walls = 0;
      for (int deg = -45; deg < 45; ++deg) {
        const double azimuth = radians(90.0 * side + deg);
        const Vector3d direction(std::cos(azimuth), std::sin(azimuth), 0.0);
        walls += caster.cast(sensor, pose.linear() * direction, 60.0).has_value();
      }
      EXPECT_GT(walls, 20) << "at " << sensor.transpose() << ", side " << side;
    }
  }
}

TEST(SimCarPark, DriveIsALoopThatEndsExactlyAtItsStart) {
  const Motion drive = make_world("parking", 1).motion;
  EXPECT_GT(path_length(drive), 180.0);
  const Pose change = drive.pose(0).inverse() * drive.pose(drive.duration_ns);
  EXPECT_LT(change.translation().norm(), 1e-9);
  EXPECT_LT(rotation_angle(change), 1e-9);
}

TEST(SimStreet, DriveEndsOnItsFirstStreetInTheSameDirection) {
  const Motion drive = make_world("street", 1).motion;
  EXPECT_GT(path_length(drive), 1000.0);
  const Pose end = drive.pose(drive.duration_ns);
  double travelled = 0.0;
  std::int64_t t = 0;
  while ((drive.pose(t).inverse() * end).translation().x() > 0.0) {
    travelled += (drive.pose(t + second / 10).translation() - drive.pose(t).translation()).norm();
    t += second / 10;
  }
  EXPECT_GT(travelled, 50.0);
  EXPECT_LT(travelled, 100.0);
  const Pose between = drive.pose(t).inverse() * end;
  EXPECT_LT(std::abs(between.translation().y()), 0.5);
  EXPECT_LT(rotation_angle(between), radians(2.0));
}

TEST(SimWorldNames, AnUnknownWorldIsAnErrorThatListsTheKnownOnes) {
  try {
    make_world("moon", 1);
    FAIL() << "no error";
  } catch (const InputError& error) {
    for (const WorldKind& kind : world_kinds())
      EXPECT_NE(std::string(error.what()).find(kind.name), std::string::npos);
  }
}

TEST(SimWorldNames, ARouteIsAskedForWhereItIsNeededAndRefusedWhereItIsNot) {
  EXPECT_THROW(make_world("city", 1), InputError);
  EXPECT_THROW(make_world("street", 1, Trajectory(2)), InputError);
  EXPECT_THROW(make_world("moon", 1, Trajectory(2)), InputError);
}

}  // namespace
}  // namespace lego_loam_sc
