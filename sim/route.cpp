// SPDX-License-Identifier: BSD-3-Clause
#include "sim/route.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/geometry.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;

constexpr double kTargetSpacing = 0.25;  // m, well below any corner radius

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// A leg (curvature 0) or an arc.
struct Segment {
  Vector2d start;
  Vector2d direction;  // at the start
  double length;
  double curvature;

  Vector2d at(double distance) const {
    if (curvature == 0.0) return start + distance * direction;
    const double angle = curvature * distance;
    return start + std::sin(angle) / curvature * direction +
           (1.0 - std::cos(angle)) / curvature * left_of(direction);
  }
};

std::vector<Segment> legs_and_arcs(const std::vector<Vector2d>& waypoints, double radius) {
  std::vector<Segment> segments;
  Vector2d from = waypoints.front();
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Vector2d& corner = waypoints[i];
    const Vector2d leg = corner - waypoints[i - 1];
    const Vector2d direction = leg.normalized();
    if (i + 1 == waypoints.size()) {
      segments.push_back({from, direction, (corner - from).norm(), 0.0});
      break;
    }
    const Vector2d next_leg = waypoints[i + 1] - corner;
    const Vector2d next_direction = next_leg.normalized();
    const double turn = std::atan2(cross(direction, next_direction), direction.dot(next_direction));
    // The arc touches both legs at this distance from the corner.
    const double tangent = std::min(
        {radius * std::tan(0.5 * std::abs(turn)), 0.5 * leg.norm(), 0.5 * next_leg.norm()});
    const Vector2d arc_start = corner - tangent * direction;
    segments.push_back({from, direction, (arc_start - from).norm(), 0.0});
    if (tangent > 0.0) {
      const double curvature = std::tan(0.5 * turn) / tangent;
      segments.push_back({arc_start, direction, turn / curvature, curvature});
    }
    from = corner + tangent * next_direction;
  }
  return segments;
}

}  // namespace

Route::Route(const std::vector<Vector2d>& waypoints, double corner_radius) {
  const std::vector<Segment> segments = legs_and_arcs(waypoints, corner_radius);
  double length = 0.0;
  for (const Segment& segment : segments) length += segment.length;
  const double intervals = std::ceil(length / kTargetSpacing);
  spacing_ = length / intervals;

  auto segment = segments.begin();
  double segment_start = 0.0;
  for (double i = 0.0; i < intervals; ++i) {
    while (i * spacing_ > segment_start + segment->length && segment + 1 != segments.end())
      segment_start += (segment++)->length;
    controls_.push_back(segment->at(i * spacing_ - segment_start));
  }
  controls_.push_back(waypoints.back());
}

// Beyond its ends the route goes straight on, so that the spline starts and ends on a control.
Vector2d Route::control(std::ptrdiff_t i) const {
  const auto last = static_cast<std::ptrdiff_t>(controls_.size()) - 1;
  if (i < 0) return 2.0 * controls_.front() - controls_[static_cast<std::size_t>(-i)];
  if (i > last) return 2.0 * controls_.back() - controls_[static_cast<std::size_t>(2 * last - i)];
  return controls_[static_cast<std::size_t>(i)];
}

Route::Point Route::at(double distance) const {
  const double knot =
      std::min(std::floor(distance / spacing_), static_cast<double>(controls_.size() - 2));
  const auto i = static_cast<std::ptrdiff_t>(knot);
  const double u = distance / spacing_ - knot;
  const double v = 1.0 - u;
  const Vector2d a = control(i - 1), b = control(i), c = control(i + 1), d = control(i + 2);
  const Vector2d position = (v * v * v * a + (4.0 - 6.0 * u * u + 3.0 * u * u * u) * b +
                             (4.0 - 6.0 * v * v + 3.0 * v * v * v) * c + u * u * u * d) /
                            6.0;
  const Vector2d velocity =
      0.5 * (v * v * (b - a) + (1.0 + 2.0 * u * v) * (c - b) + u * u * (d - c));
  const Vector2d acceleration = v * (a - 2.0 * b + c) + u * (b - 2.0 * c + d);
  const double speed = velocity.norm();
  return {position, velocity / speed, cross(velocity, acceleration) / (speed * speed * speed)};
}

}  // namespace lego_loam_sc
