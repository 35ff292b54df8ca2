// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {

struct StampedPose {
  std::int64_t stamp_ns = 0;
  Pose pose = Pose::Identity();
};

using Trajectory = std::vector<StampedPose>;

}  // namespace lego_loam_sc
