// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/body_mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "made_scenes.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kNoise = 0.01;
constexpr double kCabWall = 2.2;  // m behind the sensor

bool behind(const Eigen::Vector3f& p) {
  return p.x() < -0.5F * std::hypot(p.x(), p.y());
}

// A cab wall behind the sensor hides what is there.
Scan with_cab(Scan scan, std::uint64_t seed) {
  Random random(seed);
  for (Eigen::Vector3f& p : scan.points) {
    if (!behind(p)) continue;
    const Eigen::Vector3f direction = p.normalized();
    const double range = kCabWall / -direction.x() + kNoise * random.gaussian();
    if (range < p.norm()) p = static_cast<float>(range) * direction;
  }
  return scan;
}

struct Marked {
  std::size_t body = 0;  // of the points behind
  std::size_t behind = 0;
  std::size_t other = 0;  // marked, but not behind
};

Marked drive(const Scene& scene, double step, double turn_deg, bool cab, int scans = 30) {
  const SensorModel sensor = made_sensor(900);
  BodyMask mask(sensor);
  Marked marked;
  for (int k = 0; k < scans; ++k) {
    Scan scan = take_scan(scene, sensor, pose_of(-8.0 + step * k, 0.5, 1.8, turn_deg * k),
                          {0, kNoise, std::uint64_t(k)});
    if (cab) scan = with_cab(std::move(scan), 1000 + k);
    const RangeImage image = project(scan, sensor);
    mask.observe(image);
    if (k + 1 < scans) continue;
    std::vector<std::uint8_t> remove(image.size(), 0);
    mask.mark(image, remove);
    for (std::size_t i = 0; i < image.size(); ++i) {
      const bool is_cab = cab && behind(image.points[i]) && image.points[i].x() > -kCabWall - 0.1;
      marked.behind += is_cab;
      (is_cab ? marked.body : marked.other) += remove[i];
    }
  }
  return marked;
}

TEST(BodyMask, FindsTheVehicleAroundTheSensor) {
  for (const double step : {0.05, 0.4}) {
    const Marked marked = drive(street(), step, 0.0, true);
    EXPECT_GT(marked.behind, 1000U);
    EXPECT_GT(marked.body, 0.6 * static_cast<double>(marked.behind)) << step;
  }
}

TEST(BodyMask, TakesNoSurfaceAlongTheWayForIt) {
  for (const Scene& scene : {street(), hall(), corridor()})
    for (const double step : {0.0, 0.05})
      for (const double turn_deg : {0.0, 2.0})
        EXPECT_EQ(drive(scene, step, turn_deg, false).other, 0U) << step << " m " << turn_deg;
}

TEST(BodyMask, SaysNothingWhileTheSensorStands) {
  const Marked marked = drive(street(), 0.0, 0.0, true);
  EXPECT_EQ(marked.body + marked.other, 0U);
}

}  // namespace
}  // namespace lego_loam_sc
