// SPDX-License-Identifier: BSD-3-Clause
#include "sim/city_route.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/city_streets.hpp"
#include "sim/drive.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;

constexpr double kSensorHeight = 1.73;  // m
// The middle of the street is rounded with the larger radius as far as `kCornerLeg` (m) on either
// side of a crossing allows: gentle bends are long, a right angle has a radius of half the leg.
constexpr double kRadius = 150.0, kCornerLeg = 24.0;
constexpr double kSpacing = 3.0;                 // m between the points of the lane
constexpr double kEndBeyondStart = 25.0;         // m
constexpr std::int64_t kInterval = 100'000'000;  // ns

// A crossing of the street grid, by column and row.
struct Crossing {
  int i, j;
};

constexpr std::array<double, 5> kColumns = {-235.0, -111.0, 0.0, 126.0, 252.0};  // m
constexpr std::array<double, 5> kRows = {0.0, 104.0, 224.0, 343.0, 457.0};

// Streets are driven again in the same direction, against it and across.
constexpr auto kWay = std::to_array<Crossing>(
    {{2, 0}, {2, 1}, {2, 2}, {3, 2}, {3, 1}, {2, 1}, {2, 2}, {2, 3}, {2, 4}, {1, 4}, {0, 4}, {0, 3},
     {1, 3}, {2, 3}, {3, 3}, {4, 3}, {4, 2}, {3, 2}, {2, 2}, {1, 2}, {1, 3}, {2, 3}, {3, 3}, {3, 2},
     {3, 1}, {4, 1}, {4, 0}, {3, 0}, {3, 1}, {2, 1}, {1, 1}, {1, 0}, {2, 0}, {2, 1}});

// From rest to rest: where a leg ends, how fast it is driven, how long the vehicle then waits.
struct Leg {
  double end;    // m from the start; beyond the route: at its end
  double speed;  // m/s
  double wait;   // s
};

constexpr auto kLegs = std::to_array<Leg>({{310.0, 11.5, 5.0},
                                           {1010.0, 12.0, 10.0},
                                           {1450.0, 11.5, 3.0},
                                           {2080.0, 12.0, 6.5},
                                           {3120.0, 12.0, 3.1},
                                           {1e9, 12.0, 0.0}});

Vector2d place_of(const Crossing& c) {
  return {kColumns[c.i] + 9.0 * std::sin(1.7 * c.j + c.i), kRows[c.j] + 8.0 * std::sin(2.1 * c.i)};
}

// Streets are a little curved, in the same way in both directions.
Vector2d middle_of(const Crossing& a, const Crossing& b) {
  const Vector2d across = (place_of(a) - place_of(b)).unitOrthogonal();
  const double sign = a.i + a.j < b.i + b.j ? 1.0 : -1.0;
  const double bulge = 5.0 * std::sin(2.3 * (a.i + b.i) + 3.1 * (a.j + b.j));
  return 0.5 * (place_of(a) + place_of(b)) + sign * bulge * across;
}

double hill(const Vector2d& p) {
  return 9.0 * std::sin(p.x() / 130.0 + 0.4) * std::cos(p.y() / 150.0) +
         2.0 * std::sin(p.y() / 60.0);
}

// The right-hand lane, as points `kSpacing` apart.
Polyline lane() {
  std::vector<Vector2d> waypoints = {place_of(kWay.front())};
  for (std::size_t k = 1; k < kWay.size(); ++k) {
    const Vector2d from = place_of(kWay[k - 1]), to = place_of(kWay[k]);
    const Vector2d half_way = middle_of(kWay[k - 1], kWay[k]);
    waypoints.emplace_back(from + kCornerLeg * (half_way - from).normalized());
    waypoints.push_back(half_way);
    waypoints.emplace_back(to + kCornerLeg * (half_way - to).normalized());
    waypoints.push_back(to);
  }
  const Route middle(waypoints, kRadius);
  const double first_street = (place_of(kWay[1]) - place_of(kWay[0])).norm();
  Polyline line;
  for (double s = 0.0; s <= middle.length() - first_street + kEndBeyondStart; s += kSpacing)
    line.push_back(middle.at(s).position);
  return shifted(line, -0.5 * kLaneOffset);
}

}  // namespace

Trajectory make_city_route() {
  const Polyline line = lane();
  Trajectory route;
  std::size_t first = 0;
  for (const Leg& leg : kLegs) {
    const std::size_t last =
        std::min(static_cast<std::size_t>(leg.end / kSpacing), line.size() - 1);
    const std::vector<Vector2d> points(line.begin() + static_cast<std::ptrdiff_t>(first),
                                       line.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    const DriveSettings settings{
        .speed = leg.speed, .acceleration = 1.8, .lateral_acceleration = 2.3, .shaking = {}};
    const Drive drive(Route(points, kRadius), [](double, double) { return 0.0; }, settings);
    const auto wait_ns = static_cast<std::int64_t>(leg.wait * 1e9);
    for (std::int64_t t = 0; t < drive.duration_ns() + wait_ns; t += kInterval) {
      Pose pose = drive.pose(t);
      pose.translation().z() = hill(pose.translation().head<2>()) + kSensorHeight;
      route.push_back({static_cast<std::int64_t>(route.size()) * kInterval, pose});
    }
    first = last;
  }
  return route;
}

}  // namespace lego_loam_sc
