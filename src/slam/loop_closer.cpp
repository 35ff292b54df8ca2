// SPDX-License-Identifier: BSD-3-Clause
#include "slam/loop_closer.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "loop/radius_search.hpp"
#include "slam/edge_covariance.hpp"

namespace lego_loam_sc {
namespace {

// Mahalanobis distance of a loop from the optimised graph above which it is taken out again: of six
// degrees of freedom a true one exceeds it once in ten million.
constexpr double kContradiction = 7.0;

// Key frames near `center`, at most `reach` on each side, placed in its frame by the pose graph.
std::vector<PlacedKeyFrame> placed_round(int center, int before, int after,
                                         std::span<const KeyFrame> key_frames,
                                         std::span<const Pose> T_map_key) {
  const int first = std::max(center - before, 0);
  const int last = std::min(center + after, static_cast<int>(key_frames.size()) - 1);
  const Pose T_center_map = T_map_key[center].inverse();
  std::vector<PlacedKeyFrame> placed;
  for (int k = first; k <= last; ++k)
    placed.push_back({&key_frames[k], T_center_map * T_map_key[k]});
  return placed;
}

// How far a loop is from what the pose graph expects, in sigmas of the drift since then.
double inconsistency(const Pose& T_match_query, const Pose& expected, double travelled,
                     const VerifierSettings& settings) {
  const Pose difference = expected.inverse() * T_match_query;
  const double sigma = settings.drift_per_metre * travelled;
  const double sigma_rotation = radians(settings.drift_deg_per_metre) * travelled;
  return std::hypot(difference.translation().norm() / sigma,
                    rotation_angle(difference) / sigma_rotation);
}

}  // namespace

LoopCloser::LoopCloser(const LoopSettings& settings, const GraphSettings& graph, double range_noise,
                       LoopDetector detector)
    : settings_(settings),
      graph_settings_(graph),
      range_noise_(range_noise),
      detector_(std::move(detector)),
      contexts_(settings.scan_context) {}

std::vector<LoopCandidate> LoopCloser::candidates(std::span<const KeyFrame> key_frames,
                                                  const PoseGraph& graph) const {
  const int query = static_cast<int>(key_frames.size()) - 1;
  const KeyFrame& now = key_frames.back();
  int eligible = 0;  // key frames that are another visit, not the same one going on
  while (eligible < query &&
         now.travelled - key_frames[eligible].travelled >= settings_.min_travel &&
         1e-9 * static_cast<double>(now.reference_ns - key_frames[eligible].reference_ns) >=
             settings_.min_seconds)
    ++eligible;

  std::vector<LoopCandidate> found;
  if (settings_.scan_context.enabled) {
    found = contexts_.search(query, eligible);
    if (found.size() > 1) found.resize(1);  // c* of equation (8)
  }
  if (settings_.radius_search.enabled) {
    const auto near = search_radius(graph.poses(), query, eligible, settings_.radius_search);
    found.insert(found.end(), near.begin(), near.end());
  }
  if (detector_ && eligible > 0) {
    for (LoopCandidate candidate : detector_({key_frames, graph.poses(), eligible})) {
      if (candidate.match < 0 || candidate.match >= eligible)
        throw std::invalid_argument("the loop detector gave key frame " +
                                    std::to_string(candidate.match) + ", only those from 0 to " +
                                    std::to_string(eligible - 1) + " are eligible");
      candidate.query = query;
      candidate.detector = LoopCandidate::Detector::custom;
      found.push_back(candidate);
    }
  }
  return found;
}

LoopVerification LoopCloser::verify(const LoopCandidate& candidate,
                                    std::span<const KeyFrame> key_frames,
                                    const PoseGraph& graph) const {
  const VerifierSettings& settings = settings_.verifier;
  const std::vector<Pose>& poses = graph.poses();
  const Pose expected = poses[candidate.match].inverse() * poses[candidate.query];

  const double travelled =
      key_frames[candidate.query].travelled - key_frames[candidate.match].travelled;
  // Far apart even if drift were at its worst: not worth an ICP.
  if (settings.consistency_sigmas > 0.0 &&
      expected.translation().norm() > settings_.scan_context.reach + settings.consistency_sigmas *
                                                                         settings.drift_per_metre *
                                                                         travelled) {
    LoopVerification far;
    far.verdict = Verdict::inconsistent;
    return far;
  }

  // A detector may say how the two scans are turned, the pose graph says where they should be.
  std::vector<Pose> guesses;
  if (candidate.detector != LoopCandidate::Detector::radius) {
    Pose turned = Pose::Identity();
    turned.linear() = rotation_from_rpy(0.0, 0.0, candidate.yaw);
    guesses.push_back(turned);
  }
  if (candidate.detector != LoopCandidate::Detector::scan_context) guesses.push_back(expected);
  LoopVerification result = verify_loop(
      placed_round(candidate.query, settings.query_neighbours, 0, key_frames, poses),
      placed_round(candidate.match, settings.neighbours, settings.neighbours, key_frames, poses),
      guesses, range_noise_, settings);

  if (result.verdict == Verdict::accepted && settings.consistency_sigmas > 0.0 &&
      inconsistency(result.T_match_query, expected, travelled, settings) >
          settings.consistency_sigmas)
    result.verdict = Verdict::inconsistent;
  return result;
}

std::vector<LoopReport> LoopCloser::close(std::span<const KeyFrame> key_frames, PoseGraph& graph) {
  std::vector<LoopReport> reports;
  const KeyFrame& now = key_frames.back();
  if (now.travelled - last_loop_travelled_ < settings_.spacing) return reports;

  for (const LoopCandidate& candidate : candidates(key_frames, graph)) {
    LoopReport& report = reports.emplace_back();
    report.candidate = candidate;
    report.verification = verify(candidate, key_frames, graph);
    LoopVerification& verification = report.verification;
    if (verification.verdict != Verdict::accepted) continue;

    graph.add_loop({candidate.match, candidate.query, verification.T_match_query,
                    loop_covariance(verification.covariance, verification.T_match_query.linear(),
                                    graph_settings_)});
    graph.optimise();
    const std::size_t added = graph.loop_edges().size() - 1;
    if (graph.loop_chi(added) > kContradiction) {
      graph.remove_loop(added);
      graph.optimise();
      verification.verdict = Verdict::contradicted;
      continue;
    }
    last_loop_travelled_ = now.travelled;
    break;  // one loop for each key frame
  }
  return reports;
}

}  // namespace lego_loam_sc
