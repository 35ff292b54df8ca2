// SPDX-License-Identifier: BSD-3-Clause
#include "sim/shaking.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "sim/random.hpp"

namespace lego_loam_sc {

ShakingMotion::ShakingMotion(const Shaking& rms, std::uint64_t seed) {
  const std::array<double, 4> values = {radians(rms.roll_deg), radians(rms.pitch_deg),
                                        radians(rms.yaw_deg), rms.z};
  Random random(seed);
  for (std::size_t i = 0; i < noise_.size(); ++i) {
    for (Sine& sine : noise_[i]) {
      sine.amplitude = values[i] * std::sqrt(2.0 / static_cast<double>(noise_[i].size()));
      sine.frequency = 2.0 * std::numbers::pi * random.uniform(0.5, 4.0);
      sine.phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    }
  }
}

Pose ShakingMotion::at(double time, double strength) const {
  std::array<double, 4> value{};
  for (std::size_t i = 0; i < value.size(); ++i)
    for (const Sine& sine : noise_[i])
      value[i] += strength * sine.amplitude * std::sin(sine.frequency * time + sine.phase);
  Pose pose = Pose::Identity();
  pose.linear() = rotation_from_rpy(value[0], value[1], value[2]);
  pose.translation().z() = value[3];
  return pose;
}

}  // namespace lego_loam_sc
