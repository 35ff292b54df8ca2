// SPDX-License-Identifier: BSD-3-Clause
#include "loop/loop_closer.hpp"

#include <algorithm>
#include <utility>

#include "graph/edge_covariance.hpp"
#include "loop/redundancy.hpp"
#include "loop/verify_candidate.hpp"

namespace lego_loam_sc {
namespace {

// m; until so far after a loop the pose graph knows where it is. Then another loop is probably
// redundant, and a place that another visit has been to is known.
constexpr double kTrusted = 100.0;

}  // namespace

LoopCloser::LoopCloser(const LoopSettings& settings, const GraphSettings& graph, double range_noise,
                       LoopDetector detector)
    : settings_(settings),
      graph_settings_(graph),
      range_noise_(range_noise),
      search_(settings, std::move(detector)),
      pacing_(settings.spacing),
      insertion_(settings.contradiction_sigmas) {}

std::vector<LoopReport> LoopCloser::close(const KeyFrames& key_frames, ScanContext context,
                                          MapFragments& fragments, PoseGraph& graph) {
  const DriveView drive{key_frames, fragments, graph};
  const int eligible = count_eligible(drive, settings_);
  std::vector<LoopReport> reports;
  // Loops that join maps are sought at every key frame.
  if (!pacing_.pauses(drive.travelled()) || fragments.maps() > 1)
    reports = try_candidates(search_.candidates(drive, eligible, context), drive, fragments, graph);
  if (fragments.maps() > 1 || !is_known_place(drive, eligible))
    search_.add_place(drive, std::move(context));
  return reports;
}

// One after the other, until one is accepted.
std::vector<LoopReport> LoopCloser::try_candidates(const std::vector<LoopCandidate>& candidates,
                                                   const DriveView& drive, MapFragments& fragments,
                                                   PoseGraph& graph) {
  std::vector<LoopReport> reports;
  const double now = drive.travelled();
  const bool pauses = pacing_.pauses(now);
  for (const LoopCandidate& candidate : candidates) {
    if (pauses && !drive.joins_maps(candidate.match)) continue;
    LoopReport& report = reports.emplace_back();
    report.candidate = candidate;
    switch (judge(report, drive, fragments, graph)) {
      case Outcome::refused: continue;
      case Outcome::redundant:
        pacing_.on_redundant(now, count_loops_near(candidate.match, graph));
        return reports;
      case Outcome::added: pacing_.on_added(now); return reports;
    }
  }
  const bool tried = std::ranges::any_of(
      reports, [](const LoopReport& report) { return report.verification.overlap > 0.0; });
  if (!pauses && tried) pacing_.on_refused(now);
  return reports;
}

// Soon after a loop the next one is probably redundant, which a quick verification shows.
LoopCloser::Outcome LoopCloser::judge(LoopReport& report, const DriveView& drive,
                                      MapFragments& fragments, PoseGraph& graph) {
  const LoopCandidate& candidate = report.candidate;
  const double since_last_loop = pacing_.since_last_loop(drive.travelled());
  const bool joins = drive.joins_maps(candidate.match);
  const auto proves_redundant = [&](Effort effort) {
    report.verification = verify_candidate(candidate, effort, drive, range_noise_, settings_);
    return !joins && report.verification.verdict == Verdict::accepted &&
           is_redundant(edge_of(report), since_last_loop, graph);
  };
  const bool expected = !joins && since_last_loop < kTrusted;
  if ((expected && proves_redundant(Effort::quick)) || proves_redundant(Effort::full))
    return Outcome::redundant;
  if (report.verification.verdict != Verdict::accepted) return Outcome::refused;

  report.added = insertion_.insert(edge_of(report), joins, graph);
  search_.update_positions(graph);
  if (!report.added) {
    report.verification.verdict = Verdict::contradicted;
    return Outcome::refused;
  }
  if (joins) fragments.join(candidate.match, candidate.query);
  return Outcome::added;
}

PoseEdge LoopCloser::edge_of(const LoopReport& report) const {
  const LoopVerification& verification = report.verification;
  return {report.candidate.match, report.candidate.query, verification.T_match_query,
          loop_covariance(verification.covariance, verification.T_match_query.linear(),
                          graph_settings_)};
}

bool LoopCloser::is_known_place(const DriveView& drive, int eligible) const {
  return pacing_.since_last_loop(drive.travelled()) <= kTrusted &&
         search_.has_place(drive, eligible);
}

}  // namespace lego_loam_sc
