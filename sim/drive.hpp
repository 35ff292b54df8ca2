// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.hpp"
#include "sim/geometry.hpp"
#include "sim/motion.hpp"
#include "sim/route.hpp"
#include "sim/shaking.hpp"

namespace lego_loam_sc {

/// Speed profile and dimensions of a vehicle.
struct DriveSettings {
  double speed = 1.5;                 ///< m/s on straights
  double acceleration = 0.5;          ///< m/s^2, for braking too
  double lateral_acceleration = 0.5;  ///< m/s^2, slows the vehicle in bends
  double wheel_base = 1.5;            ///< m between the axles
  double track_width = 1.0;           ///< m between the wheels of an axle
  Shaking shaking;
  std::uint64_t seed = 0;  ///< of the shaking
};

/// The ground from a distance along a route on. A route that crosses over itself, as on two
/// storeys, needs several; at the transition both must agree within the reach of the vehicle.
struct GroundSection {
  double start;  ///< m along the route, ascending, 0 for the first
  Ground ground;
};

/// The motion of a vehicle along a route, from rest to rest: exact ground truth at any time, with
/// continuous velocities.
class Drive {
 public:
  Drive(Route route, std::vector<GroundSection> sections, const DriveSettings& settings);
  /// With the same ground everywhere.
  Drive(Route route, Ground ground, const DriveSettings& settings);

  /// Until the vehicle rests at the end of the route.
  std::int64_t duration_ns() const;

  /// T_world_vehicle; the vehicle frame lies on the ground in the middle of the wheels. Before the
  /// start and after the end the vehicle rests.
  Pose pose(std::int64_t time_ns) const;

 private:
  double distance_at(double time) const;
  const Ground& ground_at(double distance) const;
  Pose shaking_at(double time) const;

  Route route_;
  std::vector<GroundSection> sections_;
  double wheel_base_, track_width_;
  std::vector<double> speeds_, times_;  // at equal distances along the route
  ShakingMotion shaking_;
};

/// The drive as the motion of a world's vehicle.
Motion motion_of(Drive drive);

}  // namespace lego_loam_sc
