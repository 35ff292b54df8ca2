// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "core/pose.hpp"

namespace lego_loam_sc {

/// RMS amplitudes of a vehicle's shaking, which is noise between 0.5 and 4 Hz.
struct Shaking {
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;
  double z = 0.0;  ///< m
};

/// Shaking over time, smooth and determined by its seed.
class ShakingMotion {
 public:
  ShakingMotion(const Shaking& rms, std::uint64_t seed);

  /// T_still_shaken at `time` (s), `strength` times as strong.
  Pose at(double time, double strength = 1.0) const;

 private:
  struct Sine {
    double amplitude, frequency, phase;  // frequency in rad/s
  };
  std::array<std::array<Sine, 8>, 4> noise_;  // roll, pitch, yaw (rad), z (m)
};

}  // namespace lego_loam_sc
