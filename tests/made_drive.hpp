// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "core/trajectory.hpp"
#include "made_scenes.hpp"
#include "slam/slam.hpp"

namespace lego_loam_sc {

constexpr double kPeriod = 0.1;
constexpr std::int64_t kPeriodNs = 100'000'000;
constexpr double kNoise = 0.01;

// An oval through the hall, driven once and a bit more: `metres` along it to the pose.
inline Pose on_the_oval(double metres) {
  constexpr double kA = 9.0, kB = 6.0;
  const double turn = metres / (0.5 * (kA + kB));
  const Eigen::Vector2d ahead(-kA * std::sin(turn), kB * std::cos(turn));
  return pose_of(kA * std::cos(turn), kB * std::sin(turn), kMadeHeight,
                 degrees(std::atan2(ahead.y(), ahead.x())));
}

// Metres that a vehicle has come which reaches `speed` (m/s) after one second.
inline double travelled(double seconds, double speed) {
  return seconds < 1.0 ? 0.5 * speed * seconds * seconds : speed * (seconds - 0.5);
}

inline Pose truth_at(double seconds, double speed) {
  return on_the_oval(travelled(seconds, speed));
}

// Motion since scan `from`, seen from the sensor there.
inline Pose truth_between(int from, int to, double speed) {
  return truth_at(from * kPeriod, speed).inverse() * truth_at(to * kPeriod, speed);
}

inline Pose error_between(const Slam& slam, int from, int to, double speed) {
  const Trajectory trajectory = slam.trajectory();
  const Pose estimate = trajectory[from].pose.inverse() * trajectory[to].pose;
  return truth_between(from, to, speed).inverse() * estimate;
}

// Sweeps of a sensor that starts from rest. The motion within a sweep is in them.
inline std::vector<Scan> drive(int scans, double speed) {
  const SensorModel sensor = made_sensor(900);
  const Scene scene = hall();
  std::vector<Scan> result;
  for (int k = 0; k < scans; ++k)
    result.push_back(take_sweep(
        scene, sensor, [&](double seconds) { return truth_at(k * kPeriod + seconds, speed); },
        {.stamp_ns = k * kPeriodNs, .noise = kNoise, .seed = 3}));
  return result;
}

}  // namespace lego_loam_sc
