// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/ground_profile.hpp"

#include <gtest/gtest.h>

#include "io/sensor_yaml.hpp"
#include "made_scenes.hpp"

namespace lego_loam_sc {
namespace {

// deg, what flat ground shows of a sensor whose beams point `error_deg` higher than it says.
std::optional<double> cone_deg(const std::string& preset, double error_deg, double pitch_deg) {
  const SensorModel sensor = load_sensor(preset);
  SensorModel beams = sensor;
  for (double& elevation : beams.elevation_deg) elevation += error_deg;
  Scene ground;
  ground.plane({0, 0, 0}, Eigen::Vector3d::UnitZ());
  Pose pose = pose_of(0, 0, 1.7);
  pose.rotate(Eigen::AngleAxisd(radians(pitch_deg), Eigen::Vector3d::UnitY()));
  Scan scan = take_scan(ground, beams, pose, {.noise = 0.01, .seed = 3});
  for (Eigen::Vector3f& p : scan.points) {
    const float horizontal = p.head<2>().norm();
    const double elevation = std::atan2(p.z(), horizontal) - radians(error_deg);
    const float range = p.norm();
    p.head<2>() *= range * static_cast<float>(std::cos(elevation)) / horizontal;
    p.z() = range * static_cast<float>(std::sin(elevation));
  }
  const RangeImage image = project(scan, sensor);
  const std::optional<double> cone = cone_of_ground(image, segment(image, sensor, 1.7, {}));
  if (!cone) return std::nullopt;
  return degrees(*cone);
}

TEST(GroundProfile, FlatGroundShowsTheErrorOfTheBeams) {
  for (const char* preset : {"vlp16", "hdl32e", "hdl64e"})
    for (const double pitch_deg : {0.0, 1.5})
      for (const double error_deg : {0.0, 0.2, -0.3}) {
        const std::optional<double> found = cone_deg(preset, error_deg, pitch_deg);
        ASSERT_TRUE(found) << preset;
        EXPECT_NEAR(*found, error_deg, 0.06) << preset << " " << pitch_deg;
      }
}

TEST(GroundProfile, WithoutGroundNothingIsSaid) {
  const RangeImage empty{.rows = 2, .columns = 10, .row_begin = {0, 0, 0}};
  EXPECT_FALSE(cone_of_ground(empty, {}));
}

}  // namespace
}  // namespace lego_loam_sc
