// SPDX-License-Identifier: BSD-3-Clause
//
// Scans from a driver of your own, and the pose after each of them. The driver here is a toy: 16
// beams in a hall of 30 x 20 x 6 m, on a vehicle that drives ahead at 1 m/s.

#include <cmath>
#include <cstdio>
#include <lego_loam_sc/slam/slam.hpp>

using namespace lego_loam_sc;

// From a sensor at `x` to the wall, floor or ceiling that a beam in `direction` meets.
float range_in_hall(float x, const Eigen::Vector3f& direction) {
  const Eigen::Vector3f low(-10.0f - x, -8.0f, -1.5f), high(20.0f - x, 12.0f, 4.5f);
  const Eigen::Array3f far = (direction.array() > 0.0f).select(high, low).array();
  return (far / direction.array()).minCoeff();
}

// What your driver does: a turn of the sensor becomes a Scan.
Scan next_turn(const SensorModel& sensor, int turn) {
  Scan scan;
  scan.stamp_ns = turn * 100'000'000LL;
  for (int column = 0; column < sensor.columns; ++column) {
    const auto offset_ns = static_cast<std::int32_t>(1e8 * column / sensor.columns);
    const auto x = static_cast<float>(1e-9 * static_cast<double>(scan.stamp_ns + offset_ns));
    const double azimuth = M_PI - 2.0 * M_PI * (column + 0.5) / sensor.columns;  // clockwise
    for (int row = 0; row < sensor.rows(); ++row) {
      const double elevation = radians(sensor.elevation_deg[row]);
      const Eigen::Vector3f direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      scan.points.push_back(range_in_hall(x, direction) * direction);
      scan.ring.push_back(row);
      scan.offset_ns.push_back(offset_ns);  // lets the SLAM undo the motion within the turn
    }
  }
  return scan;
}

int main() {
  SensorModel sensor;
  for (int row = 0; row < 16; ++row) sensor.elevation_deg.push_back(-15.0 + 2.0 * row);

  Slam slam(sensor, Settings{});
  for (int turn = 0; turn < 40; ++turn) {
    const ScanReport report = slam.process(next_turn(sensor, turn));
    const Eigen::Vector3d position = report.T_odom_lidar.translation();
    std::printf("%.1f s  %s  x %.3f  y %.3f  z %.3f m\n", 1e-9 * report.stamp_ns,
                to_string(report.status).data(), position.x(), position.y(), position.z());
  }
}
