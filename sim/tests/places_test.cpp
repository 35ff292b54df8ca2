// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/ray_caster.hpp"
#include "sim/world.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t millisecond = 1'000'000, second = 1'000 * millisecond;

// What every one of these worlds keeps to.
class SimPlaces : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(All, SimPlaces,
                         testing::Values("parking", "street", "parking1", "parking2", "mine",
                                         "tunnel", "field"),
                         [](const auto& name) { return std::string(name.param); });

TEST_P(SimPlaces, AreDecidedByTheirSeed) {
  const World first = make_world(GetParam(), 3), again = make_world(GetParam(), 3);
  EXPECT_EQ(first.mesh.vertices, again.mesh.vertices);
  EXPECT_EQ(first.mesh.triangles, again.mesh.triangles);
  EXPECT_EQ(first.mesh.reflectivity, again.mesh.reflectivity);
  EXPECT_TRUE(first.motion.pose(10 * second).isApprox(again.motion.pose(10 * second), 0.0));
  const World other = make_world(GetParam(), 4);
  EXPECT_NE(first.mesh.vertices, other.mesh.vertices);
  EXPECT_FALSE(first.motion.pose(10 * second).isApprox(other.motion.pose(10 * second), 1e-9));
}

TEST_P(SimPlaces, HaveAMeshWithoutFault) {
  const Mesh mesh = make_world(GetParam(), 1).mesh;
  ASSERT_EQ(mesh.triangles.size(), mesh.reflectivity.size());
  EXPECT_LT(mesh.triangles.size(), 1'000'000u);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      ASSERT_LT(vertex, mesh.vertices.size());
      ASSERT_TRUE(mesh.vertices[vertex].allFinite());
    }
    ASSERT_GT(mesh.reflectivity[i], 0.0f);
    ASSERT_LE(mesh.reflectivity[i], 1.0f);
  }
}

TEST_P(SimPlaces, AreDrivenFromRestToRestWithoutAJerk) {
  const Motion motion = make_world(GetParam(), 1).motion;
  const std::int64_t step = 2 * millisecond;
  Pose here = motion.pose(-step);
  Vector6 previous = Vector6::Zero();
  for (std::int64_t t = 0; t <= motion.duration_ns + 2 * step; t += step) {
    const Pose next = motion.pose(t);
    const Vector6 velocity = log_se3(here.inverse() * next) / 2e-3;
    ASSERT_LT((velocity - previous).norm(), 0.06) << "at " << t;
    here = next;
    previous = velocity;
  }
  EXPECT_LT(previous.norm(), 1e-9);
}

TEST_P(SimPlaces, LeaveTheVehicleRoomOnFirmGround) {
  const World world = make_world(GetParam(), 1);
  const RayCaster caster(world.mesh);
  for (std::int64_t t = 0; t < world.motion.duration_ns; t += second) {
    const Pose T_world_vehicle = world.motion.pose(t);
    const Vector3d sensor = T_world_vehicle * Vector3d(0, 0, world.sensor_height);
    const auto ground = caster.cast(sensor, -T_world_vehicle.linear().col(2), 10.0);
    ASSERT_TRUE(ground) << "no ground at " << sensor.transpose();
    EXPECT_NEAR(ground->range, world.sensor_height, 0.11) << "at " << sensor.transpose();
    for (int deg = 0; deg < 360; deg += 5) {
      const Vector3d direction(std::cos(radians(deg)), std::sin(radians(deg)), 0.0);
      for (const double height : {0.5, world.sensor_height})
        EXPECT_FALSE(caster.cast(T_world_vehicle * Vector3d(0, 0, height),
                                 T_world_vehicle.linear() * direction, 1.4))
            << "an obstacle at " << sensor.transpose() << ", " << deg << " deg";
    }
  }
}

}  // namespace
}  // namespace lego_loam_sc
