// SPDX-License-Identifier: BSD-3-Clause
#include "loop/verify_candidate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lego_loam_sc {
namespace {

// Of a quick verification.
constexpr int kQuickNeighbours = 2;
constexpr int kQuickLevels = 1;

VerifierSettings settings_for(Effort effort, VerifierSettings settings) {
  if (effort == Effort::full) return settings;
  settings.neighbours = std::min(settings.neighbours, kQuickNeighbours);
  settings.levels = std::min(settings.levels, kQuickLevels);
  return settings;
}

// Key frames near `center`, at most so many on each side, placed in its frame by the pose graph.
std::vector<PlacedKeyFrame> placed_round(int center, int before, int after,
                                         const DriveView& drive) {
  const std::vector<Pose>& T_map_key = drive.graph.poses();
  const int first = std::max(center - before, 0);
  const int last = std::min(center + after, drive.newest());
  const Pose T_center_map = T_map_key[center].inverse();
  std::vector<PlacedKeyFrame> placed;
  for (int k = first; k <= last; ++k)
    if (drive.fragments.same(k, center))
      placed.push_back({drive.key_frames.features(k), T_center_map * T_map_key[k]});
  return placed;
}

// m; the longest path on which drift may have built up between the two. The motion from one
// fragment to the next was not measured: a loop joined them, anywhere on the drive.
double path_length_between(const LoopCandidate& candidate, const DriveView& drive) {
  const double now = drive.key_frames.travelled(candidate.query);
  return drive.fragments.same(candidate.query, candidate.match)
             ? now - drive.key_frames.travelled(candidate.match)
             : now;
}

// A detector may say how the two scans are turned, the pose graph says where they should be.
std::vector<Pose> guesses_for(const LoopCandidate& candidate, const Pose& expected, Effort effort) {
  const bool quick = effort == Effort::quick;
  std::vector<Pose> guesses;
  if (candidate.detector != LoopCandidate::Detector::radius && !quick) {
    Pose turned = Pose::Identity();
    turned.linear() = rotation_from_rpy(0.0, 0.0, candidate.yaw);
    guesses.push_back(turned);
  }
  if (candidate.detector != LoopCandidate::Detector::scan_context || quick)
    guesses.push_back(expected);
  return guesses;
}

// How far a loop is from what the pose graph expects, in sigmas of the drift since then.
double inconsistency(const Pose& T_match_query, const Pose& expected, double path_length,
                     const VerifierSettings& settings) {
  const Pose difference = expected.inverse() * T_match_query;
  const double sigma = settings.drift_per_metre * path_length;
  const double sigma_rotation = radians(settings.drift_deg_per_metre) * path_length;
  return std::hypot(difference.translation().norm() / sigma,
                    rotation_angle(difference) / sigma_rotation);
}

}  // namespace

LoopVerification verify_candidate(const LoopCandidate& candidate, Effort effort,
                                  const DriveView& drive, double range_noise,
                                  const LoopSettings& loop_settings) {
  const VerifierSettings settings = settings_for(effort, loop_settings.verifier);
  const std::vector<Pose>& poses = drive.graph.poses();
  const Pose expected = poses[candidate.match].inverse() * poses[candidate.query];
  const bool joins = drive.joins_maps(candidate.match);
  const bool must_agree = settings.consistency_sigmas > 0.0 && !joins;

  const double path_length = path_length_between(candidate, drive);
  // Far apart even if drift were at its worst: not worth an ICP.
  if (must_agree && expected.translation().norm() >
                        loop_settings.scan_context.reach +
                            settings.consistency_sigmas * settings.drift_per_metre * path_length) {
    LoopVerification far;
    far.verdict = Verdict::inconsistent;
    return far;
  }

  LoopVerification result =
      verify_loop(placed_round(candidate.query, settings.query_neighbours, 0, drive),
                  placed_round(candidate.match, settings.neighbours, settings.neighbours, drive),
                  guesses_for(candidate, expected, effort), range_noise, settings);
  if (result.verdict != Verdict::accepted) return result;
  if (joins && result.overlap < settings.min_join_overlap) result.verdict = Verdict::low_overlap;
  if (must_agree && inconsistency(result.T_match_query, expected, path_length, settings) >
                        settings.consistency_sigmas)
    result.verdict = Verdict::inconsistent;
  return result;
}

}  // namespace lego_loam_sc
