// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "core/pose.hpp"

namespace lego_loam_sc {

/// The motion of a vehicle: exact ground truth at any time. Called concurrently.
struct Motion {
  /// T_world_vehicle; the vehicle frame lies on the ground in the middle of the wheels. Before the
  /// start and after the end the vehicle rests.
  std::function<Pose(std::int64_t time_ns)> pose;
  std::int64_t duration_ns = 0;
};

}  // namespace lego_loam_sc
