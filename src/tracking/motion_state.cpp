// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/motion_state.hpp"

#include <cmath>

namespace lego_loam_sc {
namespace {

// Seconds over which the speed is averaged.
constexpr double kSpeedMemory = 1.0;

}  // namespace

Pose MotionState::predicted_motion(double seconds) const {
  return exp_se3(twist * seconds);
}

Pose MotionState::T_map_predicted(double seconds) const {
  Pose predicted = previous.T_map_lidar * predicted_motion(seconds);
  const Eigen::Vector3d direction = -exp_se3(-twist * seconds).translation().stableNormalized();
  predicted.translation() = previous.T_map_lidar * Eigen::Vector3d(speed * seconds * direction);
  return predicted;
}

void MotionState::add_displacement(double metres, double seconds, bool constrained) {
  travelled += metres;
  if (!known)
    speed = metres / seconds;
  else if (constrained)
    speed += (1.0 - std::exp(-seconds / kSpeedMemory)) * (metres / seconds - speed);
}

}  // namespace lego_loam_sc
