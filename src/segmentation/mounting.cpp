// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/mounting.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

// m round the sensor, where the ground is dense and nearly a plane.
constexpr double kRadius = 15.0;
// Share of the points on the ground, at least. Of kMaxPoints that many are plenty, and of the
// planes through three points (RANSAC) every thousandth is then the ground.
constexpr double kMinSupport = 0.1;
constexpr std::size_t kMaxPoints = 3000;
constexpr int kTrials = 2000;
// m; roughness of the ground, and a depth below it where no surface can be seen but for strays.
constexpr double kInlierDistance = 0.1;
constexpr double kBehindDistance = 0.4;
constexpr double kMaxShareBehind = 0.03;
// A smaller tilt may be the road's, a plane that is steeper is a wall.
constexpr double kMinTiltDeg = 5.0;
constexpr double kMaxTiltDeg = 60.0;
// A tilted plane needs this many times the support of the level one, one above the sensor this many
// times that of the best below.
constexpr double kTiltedSupport = 1.5;
constexpr double kAboveSupport = 5.0;
// Patches that show how a surface is turned: three points about this far apart, m, at most a
// share of 1 / kWidest of the columns and kLongest metres.
constexpr double kPatch = 0.6;
constexpr double kLongest = 3.0;
constexpr int kWidest = 24;
// Points of several walls make a plane as well, where the field of view ends: but of the patches on
// a ground this share lie in it, within this angle.
constexpr double kLyingShare = 0.5;
constexpr double kLyingDeg = 20.0;
// What else there is stands about as upright on the ground as on a level one, or more so.
constexpr double kUprightDeg = 10.0;
constexpr double kUprightShare = 0.8;

// n.p = -height: `up` points from the plane to the sensor.
struct Plane {
  Vector3d up = Vector3d::Zero();
  double height = 0.0;
  std::size_t support = 0;  // see count_support
};

std::vector<Vector3d> points_near(const RangeImage& image) {
  std::vector<Vector3d> near;
  for (std::size_t i = 0; i < image.size(); ++i)
    if (image.range[i] < kRadius) near.emplace_back(image.points[i].cast<double>());
  std::vector<Vector3d> some;
  const std::size_t stride = near.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < near.size(); i += stride) some.push_back(near[i]);
  return some;
}

// Sets the support of a plane: its inliers minus those expected of a plane that merely cuts through
// walls, which has as many points in the layers beside it. None when too many points lie behind.
void count_support(Plane& plane, const std::vector<Vector3d>& points) {
  std::size_t inliers = 0, beside = 0, behind = 0;
  for (const Vector3d& p : points) {
    const double above = plane.up.dot(p) + plane.height;
    inliers += std::abs(above) < kInlierDistance;
    beside += std::abs(above) >= kInlierDistance && std::abs(above) < 3.0 * kInlierDistance;
    behind += above < -kBehindDistance;
  }
  const bool open =
      static_cast<double>(behind) > kMaxShareBehind * static_cast<double>(points.size());
  plane.support = open || inliers < beside / 2 ? 0 : inliers - beside / 2;
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

// Least-squares plane through the inliers.
Plane refined(Plane plane, const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  double count = 0.0;
  for (const Vector3d& p : points) {
    if (std::abs(plane.up.dot(p) + plane.height) >= kInlierDistance) continue;
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

// The best ground plane of each kind.
struct GroundPlanes {
  Plane level, tilted, above;
};

GroundPlanes find_ground_planes(const std::vector<Vector3d>& points) {
  const double min_cosine_level = std::cos(radians(kMinTiltDeg));
  const double min_cosine_tilted = std::cos(radians(kMaxTiltDeg));
  std::mt19937 random(1);
  const auto random_point = [&]() -> const Vector3d& { return points[random() % points.size()]; };
  GroundPlanes planes;
  const auto keep_better = [](Plane& best, const Plane& plane) {
    if (plane.support > best.support) best = plane;
  };
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vector3d &a = random_point(), &b = random_point(), &c = random_point();
    std::optional<Plane> plane = plane_through(a, b, c);
    if (!plane || std::abs(plane->up.z()) < min_cosine_tilted) continue;
    count_support(*plane, points);
    if (plane->up.z() < 0.0)
      keep_better(planes.above, *plane);
    else
      keep_better(plane->up.z() > min_cosine_level ? planes.level : planes.tilted, *plane);
  }
  return planes;
}

struct Patch {
  Vector3d point;
  Vector3d normal;
};

std::vector<Patch> patches_near(const RangeImage& image) {
  std::vector<Patch> patches;
  const double column_angle = 2.0 * 3.14159265358979323846 / image.columns;
  const std::size_t stride = image.size() / kMaxPoints + 1;
  for (int row = 0; row + 1 < image.rows; ++row)
    for (std::size_t i = image.row_begin[row]; i < image.row_begin[row + 1]; i += stride) {
      if (image.range[i] >= kRadius) continue;
      const int step = static_cast<int>(std::ceil(kPatch / (image.range[i] * column_angle)));
      const int column = image.column[i];
      const std::int32_t beside =
          image.pixel(row, (column + std::min(step, image.columns / kWidest)) % image.columns);
      const std::int32_t above = image.pixel(row + 1, column);
      if (beside < 0 || above < 0) continue;
      const Vector3d point = image.points[i].cast<double>();
      const Vector3d a = image.points[beside].cast<double>() - point;
      const Vector3d b = image.points[above].cast<double>() - point;
      if (a.norm() > kLongest || b.norm() > kLongest) continue;
      patches.push_back({point, a.cross(b).normalized()});
    }
  return patches;
}

std::size_t count_upright(const std::vector<Patch>& patches, const Vector3d& up) {
  const double most = std::sin(radians(kUprightDeg));
  return std::count_if(patches.begin(), patches.end(),
                       [&](const Patch& patch) { return std::abs(patch.normal.dot(up)) < most; });
}

bool lies_in(const std::vector<Patch>& patches, const Plane& plane) {
  const double least = std::cos(radians(kLyingDeg));
  std::size_t on = 0, lying = 0;
  for (const Patch& patch : patches) {
    if (std::abs(plane.up.dot(patch.point) + plane.height) >= kInlierDistance) continue;
    ++on;
    lying += std::abs(patch.normal.dot(plane.up)) > least;
  }
  return lying > 0 && static_cast<double>(lying) >= kLyingShare * static_cast<double>(on);
}

// The surfaces themselves must bear out what the points of a plane suggest.
bool is_ground(const Plane& plane, const RangeImage& image) {
  if (std::abs(plane.up.z()) < std::cos(radians(kMaxTiltDeg))) return false;
  const std::vector<Patch> patches = patches_near(image);
  const auto upright_of = [&](const Vector3d& up) {
    return static_cast<double>(count_upright(patches, up));
  };
  return lies_in(patches, plane) &&
         upright_of(plane.up) >= kUprightShare * upright_of(Vector3d::UnitZ());
}

std::optional<Plane> find_tilted_ground(const RangeImage& image) {
  const std::vector<Vector3d> points = points_near(image);
  if (points.size() < 100) return std::nullopt;
  const GroundPlanes planes = find_ground_planes(points);
  const auto support_of = [](const Plane& plane) { return static_cast<double>(plane.support); };
  Plane best = planes.level;
  if (support_of(planes.tilted) > kTiltedSupport * support_of(planes.level)) best = planes.tilted;
  if (support_of(planes.above) > kAboveSupport * support_of(best)) best = planes.above;
  if (support_of(best) < kMinSupport * static_cast<double>(points.size())) return std::nullopt;
  best = refined(refined(best, points), points);
  if (best.up.z() > std::cos(radians(kMinTiltDeg)) || !is_ground(best, image)) return std::nullopt;
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
