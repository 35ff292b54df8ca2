// SPDX-License-Identifier: BSD-3-Clause
#include "sim/city_streets.hpp"

#include <algorithm>
#include <cmath>

#include "sim/geometry.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;

constexpr double kSideLength = 75.0;     // m
constexpr double kShortest = 50.0;       // m; a shorter side street is none
constexpr double kMouth = 25.0;          // m in which a side street leaves the others
constexpr double kApart = 20.0;          // m between it and the others from there on
constexpr double kBend = 0.8;            // rad within 24 m: the route turns into another street
constexpr double kBetweenMouths = 45.0;  // m along the route

// Angle by which the route turns between 12 m before and 12 m after.
double turn_at(const UniformSpline<Vector2d>& path, double s) {
  const Vector2d in = path.derivative(s - 12.0), out = path.derivative(s + 12.0);
  return std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
}

bool is_sharpest(const UniformSpline<Vector2d>& path, double s) {
  const double turn = std::abs(turn_at(path, s));
  if (turn < kBend) return false;
  for (double d = 1.0; d <= 12.0; d += 1.0)
    if (std::abs(turn_at(path, s - d)) > turn || std::abs(turn_at(path, s + d)) >= turn)
      return false;
  return true;
}

// Collects side streets that keep clear of all streets but for their mouth.
class SideStreets {
 public:
  SideStreets(std::vector<Street>& streets, const Vector2d& low, const Vector2d& high)
      : streets_(streets), low_(low), high_(high), map_(map_of_streets()) {}

  void add(const Vector2d& mouth, const Vector2d& direction) {
    Polyline line;
    for (double s = 0.0; s <= kSideLength; s += 1.0) {
      const Vector2d here = mouth + s * direction;
      if (s > kMouth && map_.distance(here) < kApart) break;
      line.push_back(here);
    }
    if (static_cast<double>(line.size()) < kShortest) return;
    streets_.push_back({line, 0.5 * kLaneOffset, 0.5 * kLaneOffset});
    map_ = map_of_streets();
  }

 private:
  LaneMap map_of_streets() const { return {lanes_of(streets_), low_, high_, 4.0, kApart + 6.0}; }

  std::vector<Street>& streets_;
  Vector2d low_, high_;
  LaneMap map_;
};

}  // namespace

Polyline shifted(const Polyline& line, double left) {
  Polyline result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector2d& before = line[i > 0 ? i - 1 : 0];
    const Vector2d& after = line[std::min(i + 1, line.size() - 1)];
    const Vector2d along = (after - before).normalized();
    const Vector2d point = line[i] + left * left_of(along);
    if (result.empty() || (point - result.back()).dot(along) > 0.0) result.push_back(point);
  }
  return result;
}

std::vector<Polyline> lanes_of(const std::vector<Street>& streets) {
  std::vector<Polyline> lanes;
  for (const Street& street : streets) {
    lanes.push_back(shifted(street.line, street.left));
    lanes.push_back(shifted(street.line, -street.right));
  }
  return lanes;
}

std::vector<Street> make_streets(const UniformSpline<Vector2d>& path, std::uint64_t seed) {
  Polyline line;
  // The street goes on before the start and after the end.
  for (double s = -80.0; s <= path.end() + 80.0; s += 1.0) line.push_back(path.at(s));
  Vector2d low = line.front(), high = low;
  for (const Vector2d& point : line) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  std::vector<Street> streets = {{line, kLaneOffset, 0.0}};
  SideStreets side_streets(streets, low - Vector2d(100, 100), high + Vector2d(100, 100));
  Random random(seed);
  double last_mouth = 0.0;
  for (double s = 20.0; s < path.end() - 20.0; s += 1.0) {
    const Vector2d direction = path.derivative(s).normalized();
    const Vector2d middle = path.at(s) + 0.5 * kLaneOffset * left_of(direction);
    if (is_sharpest(path, s)) {
      side_streets.add(middle, path.derivative(s - 12.0).normalized());
      side_streets.add(middle, -path.derivative(s + 12.0).normalized());
      last_mouth = s;
    } else if (s > last_mouth + kBetweenMouths && random.chance(0.02)) {
      const double side = random.chance(0.5) ? 1.0 : -1.0;
      const Vector2d across = side * left_of(direction) + random.uniform(-0.2, 0.2) * direction;
      side_streets.add(middle, across.normalized());
      last_mouth = s;
    }
  }
  return streets;
}

}  // namespace lego_loam_sc
