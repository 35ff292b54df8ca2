// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "loop/loop_candidate.hpp"
#include "loop/settings.hpp"

namespace lego_loam_sc {

/// LeGO-LOAM's own loop detector: those of `key_frames`, which lie at `positions`, within
/// `settings.radius` of `position`, that of key frame `query`; at most `settings.candidates` of
/// them, nearest first, of equal ones the earlier first.
std::vector<LoopCandidate> search_radius(int query, const Eigen::Vector3d& position,
                                         std::span<const int> key_frames,
                                         std::span<const Eigen::Vector3d> positions,
                                         const RadiusSearchSettings& settings);

}  // namespace lego_loam_sc
