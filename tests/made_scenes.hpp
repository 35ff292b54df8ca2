// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/pose.hpp"
#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "features/features.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "sim/random.hpp"
#include "slam/settings.hpp"

namespace lego_loam_sc {

/// Planes, boxes and poles: the range of a beam has a closed form, so a scan of them is truth.
class Scene {
 public:
  Scene& plane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    planes_.push_back({point, normal.normalized()});
    return *this;
  }

  /// Axis-aligned; from within it is a room.
  Scene& box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    boxes_.push_back({low, high});
    return *this;
  }

  /// Upright, without caps.
  Scene& pole(double x, double y, double radius, double bottom, double top) {
    poles_.push_back({x, y, radius, bottom, top});
    return *this;
  }

  /// Distance to the first surface along a unit direction, or infinity.
  double range(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    const auto meet = [&](double t) {
      if (t > 0.0 && t < nearest) nearest = t;
    };
    for (const Plane& p : planes_) meet(p.normal.dot(p.point - origin) / p.normal.dot(direction));
    for (const Box& b : boxes_) meet(to_box(b, origin, direction));
    for (const Pole& p : poles_) meet(to_pole(p, origin, direction));
    return nearest;
  }

 private:
  struct Plane {
    Eigen::Vector3d point, normal;
  };
  struct Box {
    Eigen::Vector3d low, high;
  };
  struct Pole {
    double x, y, radius, bottom, top;
  };

  static double to_box(const Box& b, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    const Eigen::Array3d s = (b.low - o).array() / d.array();
    const Eigen::Array3d t = (b.high - o).array() / d.array();
    const double enter = s.min(t).maxCoeff();
    const double leave = s.max(t).minCoeff();
    if (enter > leave) return -1.0;
    return enter > 0.0 ? enter : leave;
  }

  static double to_pole(const Pole& p, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
    const Eigen::Vector2d from(o.x() - p.x, o.y() - p.y);
    const double a = d.head<2>().squaredNorm();
    const double b = from.dot(d.head<2>());
    const double root = b * b - a * (from.squaredNorm() - p.radius * p.radius);
    if (root < 0.0) return -1.0;
    const double t = (-b - std::sqrt(root)) / a;
    const double z = o.z() + t * d.z();
    return z >= p.bottom && z <= p.top ? t : -1.0;
  }

  std::vector<Plane> planes_;
  std::vector<Box> boxes_;
  std::vector<Pole> poles_;
};

/// Sixteen beams 2 degrees apart. Its beams fire at the middle of the columns of the range image.
inline SensorModel made_sensor(int columns = 1800) {
  SensorModel sensor;
  sensor.name = "made";
  for (int row = 0; row < 16; ++row) sensor.elevation_deg.push_back(-15.0 + 2.0 * row);
  sensor.columns = columns;
  sensor.min_range = 0.5;
  sensor.max_range = 100.0;
  sensor.range_noise = 0.01;
  return sensor;
}

inline Eigen::Vector3d beam(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

inline double column_azimuth(const SensorModel& sensor, int column) {
  return 2.0 * M_PI * (column + 0.5) / sensor.columns - M_PI;
}

/// T_world_lidar, `seconds` after the stamp.
using PoseAt = std::function<Pose(double seconds)>;

struct ScanOptions {
  std::int64_t stamp_ns = 0;
  double noise = 0.0;  ///< m, one sigma of the range
  std::uint64_t seed = 0;
};

/// One sweep in the order of firing, with rings and times. Each column is seen from the pose at
/// its own time.
inline Scan take_sweep(const Scene& scene, const SensorModel& sensor, const PoseAt& pose_at,
                       const ScanOptions& options = {}) {
  Scan scan;
  scan.stamp_ns = options.stamp_ns;
  Random random(hash(options.seed, static_cast<std::uint64_t>(options.stamp_ns)));
  const double start = radians(sensor.start_azimuth_deg);
  for (int k = 0; k < sensor.columns; ++k) {
    const double turn = (k + 0.5) / sensor.columns;
    const double azimuth = start + (sensor.clockwise ? -2.0 : 2.0) * M_PI * turn;
    const Pose T_world_lidar = pose_at(turn * sensor.period);
    for (int row = 0; row < sensor.rows(); ++row) {
      const Eigen::Vector3d direction = beam(azimuth, radians(sensor.elevation_deg[row]));
      const double exact =
          scene.range(T_world_lidar.translation(), T_world_lidar.linear() * direction);
      const double range = exact + options.noise * random.gaussian();
      if (!(range <= sensor.max_range)) continue;
      scan.points.push_back((range * direction).cast<float>());
      scan.intensity.push_back(static_cast<float>(row));
      scan.ring.push_back(static_cast<std::uint16_t>(row));
      scan.offset_ns.push_back(static_cast<std::int32_t>(std::llround(1e9 * turn * sensor.period)));
    }
  }
  return scan;
}

/// A scan of a sensor at rest, or of one whose motion is compensated: without times.
inline Scan take_scan(const Scene& scene, const SensorModel& sensor, const Pose& T_world_lidar,
                      const ScanOptions& options = {}) {
  Scan scan = take_sweep(scene, sensor, [&](double) { return T_world_lidar; }, options);
  scan.offset_ns.clear();
  return scan;
}

inline Pose pose_of(double x, double y, double z, double yaw_deg = 0.0) {
  Pose pose = Pose::Identity();
  pose.translation() << x, y, z;
  pose.linear() = rotation_from_rpy(0.0, 0.0, radians(yaw_deg));
  return pose;
}

/// What the stages make of a scan. `height` of the sensor in m.
struct Staged {
  RangeImage image;
  Segmentation segmentation;
  Features features;
};
inline Staged through_stages(const Scan& scan, const SensorModel& sensor, double height,
                             const Settings& settings = {}) {
  Staged s;
  s.image = project(scan, sensor);
  s.segmentation = segment(s.image, sensor, height, settings.segmentation);
  s.features = extract_features(s.image, s.segmentation, sensor, settings.features);
  return s;
}

constexpr double kMadeHeight = 1.8;  ///< of the sensor in the scenes below, m

/// A street along x, on the ground z = 0: houses with gaps between them, cars, poles.
inline Scene street() {
  Scene scene;
  scene.plane({0, 0, 0}, Eigen::Vector3d::UnitZ());
  for (int k = -4; k < 4; ++k) {
    const double x = 14.0 * k;
    scene.box({x, 8.0 + 0.5 * (k & 1), 0}, {x + 10.0 + (k & 1), 20, 9});
    scene.box({x + 5.0, -22, 0}, {x + 15.5, -9.5 + 0.8 * (k & 1), 7.0});
    scene.box({x + 2.0, 4.2, 0}, {x + 6.2, 5.9, 1.5});
    scene.pole(x + 8.0, 6.3, 0.12, 0, 6);
    scene.pole(x + 1.0, -6.5, 0.15, 0, 5);
  }
  return scene;
}

/// A hall of 36 m x 24 m, 5 m high, with pillars and crates that make each corner another.
inline Scene hall() {
  Scene scene;
  scene.box({-18, -12, 0}, {18, 12, 5});
  for (const double x : {-12.0, -4.0, 4.0, 12.0}) {
    scene.box({x - 0.3, -0.3, 0}, {x + 0.3, 0.3, 5});
    scene.pole(x + 1.5, 10.0, 0.2, 0, 5);
  }
  scene.box({-17, -11.5, 0}, {-13, -9.5, 2.6});
  scene.box({14, 9, 0}, {17.5, 11, 1.2});
  scene.box({8, -11.8, 0}, {9.5, -10, 3.4});
  scene.box({-9, 10.5, 0}, {-6, 12, 2.2});
  scene.box({16.5, -4, 0}, {18, 2, 2.8});
  scene.pole(-15.5, 3.0, 0.3, 0, 5);
  scene.pole(2.0, -10.0, 0.25, 0, 5);
  return scene;
}

/// A corridor along x without end, 4 m x 3 m: nothing in it tells where along it one stands.
inline Scene corridor() {
  Scene scene;
  scene.plane({0, 0, 0}, Eigen::Vector3d::UnitZ());
  scene.plane({0, 0, 3}, Eigen::Vector3d::UnitZ());
  scene.plane({0, -2, 0}, Eigen::Vector3d::UnitY());
  scene.plane({0, 2, 0}, Eigen::Vector3d::UnitY());
  return scene;
}

}  // namespace lego_loam_sc
