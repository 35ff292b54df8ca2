// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "loop/loop_candidate.hpp"
#include "loop/loop_verifier.hpp"

namespace lego_loam_sc {

/// What became of a loop candidate; a row of loops.csv.
struct LoopReport {
  LoopCandidate candidate;
  int query_scan = 0;
  int match_scan = 0;
  LoopVerification verification;
  bool added = false;  ///< to the pose graph, which knew the other accepted loops already
};

}  // namespace lego_loam_sc
