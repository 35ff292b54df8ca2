// SPDX-License-Identifier: BSD-3-Clause
#include "sim/beam_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/lidar.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr double height = 2.0;

Scan scan_of_floor(const SensorModel& sensor, const BeamErrors& errors) {
  Mesh floor;
  add_quad(floor,
           {Vector3d(-99, -99, 0), Vector3d(99, -99, 0), Vector3d(99, 99, 0), Vector3d(-99, 99, 0)},
           0.5);
  const auto standing = [](std::int64_t) -> Pose {
    return Pose(Eigen::Translation3d(0, 0, height));
  };
  return sweep(RayCaster(floor), sensor, standing, 0,
               {.distort = false, .noise = 0.0, .beam_errors = errors, .drop_outs = false});
}

SensorModel three_beams() {
  SensorModel sensor;
  sensor.elevation_deg = {-15.0, -10.0, -5.0};
  sensor.columns = 36;
  return sensor;
}

TEST(SimBeamErrors, ABeamThatPointsHigherMeetsTheFloorFartherAwayInTheReportedDirection) {
  const SensorModel sensor = three_beams();
  const BeamErrors errors{.elevation_deg = {0.3, -0.2, 0.0}, .range = {0.05, -0.02, 0.0}};
  const Scan scan = scan_of_floor(sensor, errors);
  ASSERT_EQ(scan.size(), 3u * 36u);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const std::size_t row = scan.ring[i];
    const Vector3d p = scan.points[i].cast<double>();
    const double true_elevation = sensor.elevation_deg[row] + errors.elevation_deg[row];
    EXPECT_NEAR(p.norm(), height / std::sin(-radians(true_elevation)) + errors.range[row], 1e-5);
    EXPECT_NEAR(degrees(std::asin(p.z() / p.norm())), sensor.elevation_deg[row], 1e-4);
  }
}

TEST(SimBeamErrors, ASensorWithoutErrorsIsAsItsModelSays) {
  const SensorModel sensor = three_beams();
  const BeamErrors none{.elevation_deg = {0.0, 0.0, 0.0}, .range = {0.0, 0.0, 0.0}};
  EXPECT_EQ(scan_of_floor(sensor, {}).points, scan_of_floor(sensor, none).points);
}

TEST(SimBeamErrors, AUsedSensorHasACommonTiltAndEachBeamItsOwnErrors) {
  constexpr int rows = 4096;
  const BeamErrors errors = used_beams(rows, 5);
  const auto mean_and_sigma = [](const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return std::pair(mean, std::sqrt(squares / n));
  };
  const auto [tilt, elevation_sigma] = mean_and_sigma(errors.elevation_deg);
  EXPECT_NEAR(tilt, 0.19, 0.003);
  EXPECT_NEAR(elevation_sigma, 0.04, 0.002);
  const auto [offset, range_sigma] = mean_and_sigma(errors.range);
  EXPECT_NEAR(offset, 0.0, 0.001);
  EXPECT_NEAR(range_sigma, 0.012, 0.0006);
}

TEST(SimBeamErrors, TheErrorsAreThoseOfTheSeed) {
  EXPECT_EQ(used_beams(64, 3).elevation_deg, used_beams(64, 3).elevation_deg);
  EXPECT_NE(used_beams(64, 3).elevation_deg, used_beams(64, 4).elevation_deg);
}

}  // namespace
}  // namespace lego_loam_sc
