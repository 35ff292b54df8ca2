// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {

/// The pose of a scan and its stamp.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  Pose pose = Pose::Identity();

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(stamp_ns, pose);
  }
};

/// In ascending order of time.
using Trajectory = std::vector<StampedPose>;

}  // namespace lego_loam_sc
