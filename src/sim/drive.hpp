// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"
#include "sim/ground.hpp"
#include "sim/motion.hpp"
#include "sim/route.hpp"

namespace lego_loam_sc {

/// Shaking of a vehicle, as root mean squares: noise between 0.5 and 4 Hz.
struct Shaking {
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;
  double z = 0.0;  ///< m
};

struct DriveSettings {
  double speed = 1.5;                 ///< m/s on straights
  double acceleration = 0.5;          ///< m/s^2, for braking too
  double lateral_acceleration = 0.5;  ///< m/s^2, slows the vehicle in bends
  double wheel_base = 1.5;            ///< m between the axles
  double track_width = 1.0;           ///< m between the wheels of an axle
  Shaking shaking;
  std::uint64_t seed = 0;  ///< of the shaking
};

/// The motion of a vehicle along a route, from rest to rest: the exact truth at any time, with
/// continuous velocities.
class Drive {
 public:
  Drive(Route route, Ground ground, const DriveSettings& settings);

  std::int64_t duration_ns() const;

  /// T_world_vehicle; the vehicle frame lies on the ground in the middle of the wheels. Before the
  /// start and after the end the vehicle rests.
  Pose pose(std::int64_t time_ns) const;

 private:
  struct Sine {
    double amplitude, frequency, phase;  // frequency in rad/s
  };
  using Noise = std::array<Sine, 8>;

  double distance_at(double time) const;
  Pose shaking_at(double time) const;

  Route route_;
  Ground ground_;
  double wheel_base_, track_width_;
  std::vector<double> speeds_, times_;  // at equal distances along the route
  std::array<Noise, 4> shaking_;        // roll, pitch, yaw (rad), z (m)
};

Motion motion_of(Drive drive);

}  // namespace lego_loam_sc
