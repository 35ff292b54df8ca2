// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/pose.hpp"
#include "core/settings.hpp"
#include "loop/loop_candidate.hpp"

namespace lego_loam_sc {

/// LeGO-LOAM's own loop detector: those of the key frames `eligible` whose estimated position lies
/// within `settings.radius` of that of key frame `query`, at most `settings.candidates` of them,
/// nearest first, of equal ones the earlier first. `T_map_key` holds the pose of each key frame.
std::vector<LoopCandidate> search_radius(std::span<const Pose> T_map_key, int query,
                                         std::span<const int> eligible,
                                         const RadiusSearchSettings& settings);

}  // namespace lego_loam_sc
