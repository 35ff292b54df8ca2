// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/mounting.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr double kReach = 15.0;  // m round the sensor
constexpr std::size_t kMostPoints = 3000;
constexpr int kTrials = 2000;          // planes through three points
constexpr double kOnPlane = 0.1;       // m
constexpr double kBeyond = 0.4;        // m below the ground there is nothing
constexpr double kMostBeyond = 0.03;   // but stray points: their share
constexpr double kLeastSupport = 0.1;  // share of the points on the ground
constexpr double kLeastTiltDeg = 5.0;
constexpr double kMostTiltDeg = 60.0;
// How many times the points of a level plane another one needs to count.
constexpr double kClearlyMore = 1.5;
constexpr double kMuchMore = 5.0;

// n.p = -height: `up` points from the plane to the sensor.
struct Plane {
  Vector3d up = Vector3d::Zero();
  double height = 0.0;
  std::size_t support = 0;  // points on it, see below
};

std::vector<Vector3d> points_near(const RangeImage& image) {
  std::vector<Vector3d> near;
  for (std::size_t i = 0; i < image.size(); ++i)
    if (image.range[i] < kReach) near.emplace_back(image.points[i].cast<double>());
  std::vector<Vector3d> some;
  const std::size_t stride = near.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < near.size(); i += stride) some.push_back(near[i]);
  return some;
}

// Counts the points on the plane; none when too many lie beyond it. A plane that only cuts through
// walls has as many beside it, layer for layer: these are taken off.
void count_support(Plane& plane, const std::vector<Vector3d>& points) {
  std::size_t on = 0, beside = 0, beyond = 0;
  for (const Vector3d& p : points) {
    const double above = plane.up.dot(p) + plane.height;
    on += std::abs(above) < kOnPlane;
    beside += std::abs(above) >= kOnPlane && std::abs(above) < 3.0 * kOnPlane;
    beyond += above < -kBeyond;
  }
  const bool open = static_cast<double>(beyond) > kMostBeyond * static_cast<double>(points.size());
  plane.support = open || on < beside / 2 ? 0 : on - beside / 2;
}

std::optional<Plane> plane_through(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Plane plane;
  plane.up = (b - a).cross(c - a);
  if (plane.up.norm() < 0.5) return std::nullopt;  // m^2; too small a triangle
  plane.up.normalize();
  plane.height = -plane.up.dot(a);
  if (plane.height < 0.0) {
    plane.up = -plane.up;
    plane.height = -plane.height;
  }
  return plane;
}

// Least squares through the points on the plane.
Plane refined(Plane plane, const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  double count = 0.0;
  for (const Vector3d& p : points) {
    if (std::abs(plane.up.dot(p) + plane.height) >= kOnPlane) continue;
    mean += p;
    square += p * p.transpose();
    ++count;
  }
  mean /= count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(square / count -
                                                              mean * mean.transpose());
  const Vector3d normal = solver.eigenvectors().col(0);
  plane.up = normal.dot(plane.up) > 0.0 ? normal : Vector3d(-normal);
  plane.height = -plane.up.dot(mean);
  count_support(plane, points);
  return plane;
}

// The best ground of each kind.
struct Grounds {
  Plane level, tilted, above;
};

Grounds find_grounds(const std::vector<Vector3d>& points) {
  const double least_level = std::cos(radians(kLeastTiltDeg));
  const double least_tilted = std::cos(radians(kMostTiltDeg));
  std::mt19937 random(1);
  const auto any = [&]() -> const Vector3d& { return points[random() % points.size()]; };
  Grounds grounds;
  const auto keep_better = [](Plane& best, const Plane& plane) {
    if (plane.support > best.support) best = plane;
  };
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector3d &a = any(), &b = any(), &c = any();
    std::optional<Plane> plane = plane_through(a, b, c);
    if (!plane || std::abs(plane->up.z()) < least_tilted) continue;
    count_support(*plane, points);
    if (plane->up.z() < 0.0)
      keep_better(grounds.above, *plane);
    else
      keep_better(plane->up.z() > least_level ? grounds.level : grounds.tilted, *plane);
  }
  return grounds;
}

std::optional<Plane> find_tilted_ground(const RangeImage& image) {
  const std::vector<Vector3d> points = points_near(image);
  if (points.size() < 100) return std::nullopt;
  const Grounds grounds = find_grounds(points);
  const auto support_of = [](const Plane& plane) { return static_cast<double>(plane.support); };
  Plane best = grounds.level;
  if (support_of(grounds.tilted) > kClearlyMore * support_of(grounds.level)) best = grounds.tilted;
  if (support_of(grounds.above) > kMuchMore * support_of(best)) best = grounds.above;
  if (support_of(best) < kLeastSupport * static_cast<double>(points.size())) return std::nullopt;
  best = refined(refined(best, points), points);
  if (best.up.z() > std::cos(radians(kLeastTiltDeg))) return std::nullopt;
  return best;
}

}  // namespace

bool estimate_tilt(const RangeImage& image, SensorModel& sensor) {
  if (sensor.height > 0.0 || sensor.tilted()) return false;
  const std::optional<Plane> ground = find_tilted_ground(image);
  if (!ground) return false;
  // R_y(pitch) R_x(roll) turns `up` to the z axis.
  const Vector3d& up = ground->up;
  sensor.mount_roll_deg = degrees(std::atan2(up.y(), up.z()));
  sensor.mount_pitch_deg = degrees(-std::atan2(up.x(), std::hypot(up.y(), up.z())));
  return true;
}

}  // namespace lego_loam_sc
