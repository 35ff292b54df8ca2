// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "key_frames/key_frames.hpp"
#include "loop/loop_candidate.hpp"

namespace lego_loam_sc {

/// Where a detector may look: all key frames and where the pose graph has them (`T_map_key`). The
/// last one is the query; those before `eligible` belong to another visit, see LoopSettings.
struct LoopQuery {
  const KeyFrames& key_frames;
  std::span<const Pose> T_map_key;
  int eligible = 0;
};

/// A loop detector of the user's own. Gives the eligible key frames that may show the place of the
/// query, best first; `match` must be set, `yaw` and `distance` are optional and the rest is filled
/// in. ICP starts from `yaw` and from where the pose graph has the two, and the verifier and the
/// graph judge these candidates as they do all others. Called only when a key frame is eligible,
/// and not just after a loop (LoopSettings::spacing).
using LoopDetector = std::function<std::vector<LoopCandidate>(const LoopQuery& query)>;

}  // namespace lego_loam_sc
