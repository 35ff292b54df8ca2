// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "loop/drive_view.hpp"
#include "loop/loop_candidate.hpp"
#include "loop/loop_verifier.hpp"
#include "loop/settings.hpp"

namespace lego_loam_sc {

/// How much work a verification is worth.
enum class Effort {
  quick,  ///< from where the pose graph has the query, few neighbours, finest level
  full,
};

/// Paper 2.3 (6) for a candidate: verify_loop with the key frames round both ends, then consistency
/// with the pose graph, whose estimate may be off by the drift since the match. `range_noise` in m,
/// one sigma.
LoopVerification verify_candidate(const LoopCandidate& candidate, Effort effort,
                                  const DriveView& drive, double range_noise,
                                  const LoopSettings& settings);

}  // namespace lego_loam_sc
