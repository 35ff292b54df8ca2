// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "features/features.hpp"
#include "loop/settings.hpp"

namespace lego_loam_sc {

/// Why a loop candidate was accepted or refused.
enum class Verdict {
  accepted,
  no_candidate,  ///< Scan Context distance above tau of equation (8)
  no_match,      ///< too few points of the query meet the local map
  low_overlap,   ///< too few of the query's points lie on a surface of the local map
  high_rmse,     ///< ICP score above the threshold
  implausible,   ///< height, roll or pitch differ more than two visits of one place can
  degenerate,    ///< the place does not fix the pose in all directions
  inconsistent,  ///< contradicts the pose graph by more than drift can explain
  contradicted,  ///< accepted at first, taken out because the optimised graph does not bear it
};

/// As it stands in loops.csv.
std::string_view to_string(Verdict verdict);

/// The features of a key frame, see unpack(), and where it stands.
struct PlacedKeyFrame {
  Features features;
  Pose T_frame_key = Pose::Identity();  ///< in the frame of the query or of the match
};

/// Result of verify_loop.
struct LoopVerification {
  Verdict verdict = Verdict::no_match;
  Pose T_match_query = Pose::Identity();
  double overlap = 0.0;                  ///< share of the query's points on the local map
  double rmse = 0.0;                     ///< m, ICP score: residual of the inliers
  Matrix6 covariance = Matrix6::Zero();  ///< of the perturbation of core/pose.hpp, match axes
};

/// Paper 2.3 (6): merges the key frames round the match into a local map, in the frame of the
/// match, and registers the query (its key frame and those before it, in the frame of the query)
/// against it, from each of the guesses, coarse to fine. The best result is judged. Consistency
/// with the pose graph is the caller's to check. `range_noise` in m, one sigma.
LoopVerification verify_loop(std::span<const PlacedKeyFrame> query,
                             std::span<const PlacedKeyFrame> match,
                             std::span<const Pose> guesses_T_match_query, double range_noise,
                             const VerifierSettings& settings);

}  // namespace lego_loam_sc
