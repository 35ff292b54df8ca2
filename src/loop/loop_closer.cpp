// SPDX-License-Identifier: BSD-3-Clause
#include "loop/loop_closer.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <ranges>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/time.hpp"
#include "graph/edge_covariance.hpp"
#include "loop/radius_search.hpp"

namespace lego_loam_sc {
namespace {

// Mahalanobis distance of a loop from the optimised graph above which it is taken out again: of six
// degrees of freedom a true one exceeds it once in ten million.
constexpr double kContradiction = 7.0;
// And that below which a loop tells the graph nothing new, when the last one was found no longer
// ago than this, m: a visit has to be tied to the one before, but whoever drives the same ways all
// day would let the graph grow without end.
constexpr double kNothingNew = 0.5;
constexpr double kSameVisit = 20.0;
// With each of them the pause before the next search doubles, up to this, m, and once more as much
// for every kWellTied loops that end near, so many times at most.
constexpr double kLongestPause = 0.3 * kSameVisit;
constexpr double kMostShares = 3.0;
// Until so far after a loop, m, the pose graph knows where it is: then a place that another visit
// has been as near to as this, m, is known.
constexpr double kTrusted = 100.0;
constexpr double kSamePlace = 2.0;
// Then a loop is expected to tell nothing new, which a few neighbours at the finest level show.
constexpr int kGlanceNeighbours = 2;
constexpr int kGlanceLevels = 1;
// Where so many loops end within this distance, m, another visit is no news unless it disagrees.
// Chi has six degrees of freedom: 2.5 is a usual value of it.
constexpr double kWellTied = 5.0;
constexpr double kPlace = 50.0;
constexpr double kDisagreement = 2.5;
// Loops that agree wait for each other until they are this share of all, and move the poses
// together. Of true ones 19 in 20 agree as well as this.
constexpr double kAgreement = 3.5;
constexpr double kWaitingShare = 1.0 / 32.0;
// Between two maps there is no pose graph to contradict a candidate. So more of them are tried, and
// more must agree: the overlap of a loop that joins them.
constexpr std::size_t kJoinCandidates = 3;
constexpr double kJoinOverlap = 0.75;

// Key frames near `center`, at most so many on each side, placed in its frame by the pose graph.
std::vector<PlacedKeyFrame> placed_round(int center, int before, int after,
                                         const KeyFrames& key_frames, const MapFragments& pieces,
                                         std::span<const Pose> T_map_key) {
  const int first = std::max(center - before, 0);
  const int last = std::min(center + after, static_cast<int>(key_frames.size()) - 1);
  const Pose T_center_map = T_map_key[center].inverse();
  std::vector<PlacedKeyFrame> placed;
  for (int k = first; k <= last; ++k)
    if (pieces.same(k, center))
      placed.push_back({key_frames.features(k), T_center_map * T_map_key[k]});
  return placed;
}

// The longest way from one key frame to the other that drift may have built up on. What lies
// between pieces was not measured: a loop joined them, anywhere on the drive.
double way_between(const LoopCandidate& candidate, const KeyFrames& key_frames,
                   const MapFragments& pieces) {
  const double now = key_frames.travelled(candidate.query);
  return pieces.same(candidate.query, candidate.match) ? now - key_frames.travelled(candidate.match)
                                                       : now;
}

// Loops that end near a key frame.
double ties(int key_frame, const PoseGraph& graph) {
  const std::vector<Pose>& poses = graph.poses();
  const Eigen::Vector3d place = poses[key_frame].translation();
  return static_cast<double>(std::ranges::count_if(graph.loop_edges(), [&](const PoseEdge& loop) {
    return (poses[loop.to].translation() - place).norm() <= kPlace;
  }));
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
      contexts_(settings.scan_context),
      pause_(settings.spacing) {}

// Key frames of other visits than the one that the newest belongs to.
int LoopCloser::count_eligible(const KeyFrames& key_frames, const MapFragments& pieces) const {
  const int query = static_cast<int>(key_frames.size()) - 1;
  const auto numbers = std::views::iota(0, query);
  return *std::ranges::partition_point(numbers, [&](int k) {
    const double age = seconds(key_frames.reference_ns(query) - key_frames.reference_ns(k));
    return !pieces.same(k, query) ||
           (key_frames.travelled(query) - key_frames.travelled(k) >= settings_.min_travel &&
            age >= settings_.min_seconds);
  });
}

bool LoopCloser::place_is_known(double travelled, int eligible, const PoseGraph& graph) const {
  if (travelled - last_loop_travelled_ > kTrusted) return false;
  RadiusSearchSettings same_place;
  same_place.radius = kSamePlace;
  same_place.candidates = 1;
  return !near_newest(eligible, graph, same_place).empty();
}

std::vector<LoopCandidate> LoopCloser::near_newest(int eligible, const PoseGraph& graph,
                                                   const RadiusSearchSettings& settings) const {
  return search_radius(static_cast<int>(graph.size()) - 1, graph.poses().back().translation(),
                       contexts_.key_frames_before(eligible), positions_, settings);
}

void LoopCloser::optimise(PoseGraph& graph) {
  graph.optimise();
  for (std::size_t i = 0; i < positions_.size(); ++i)
    positions_[i] = graph.poses()[places()[i]].translation();
}

void LoopCloser::pause(double travelled, double metres) {
  pause_ = metres;
  next_search_travelled_ = travelled + metres;
}

std::vector<LoopCandidate> LoopCloser::candidates(const KeyFrames& key_frames, int eligible,
                                                  const ScanContext& context, const MapFragments& pieces,
                                                  const PoseGraph& graph) const {
  const int query = static_cast<int>(key_frames.size()) - 1;

  std::vector<LoopCandidate> found;
  if (settings_.scan_context.enabled) {
    const std::vector<LoopCandidate> alike = contexts_.search(query, context, eligible);
    for (const LoopCandidate& candidate : alike) {
      const bool first = found.empty();  // c* of equation (8)
      const bool joins = !pieces.joined(candidate.match, query);
      if (first || (joins && found.size() < kJoinCandidates)) found.push_back(candidate);
    }
  }
  if (settings_.radius_search.enabled) {
    for (const LoopCandidate& candidate : near_newest(eligible, graph, settings_.radius_search))
      if (pieces.joined(candidate.match, query)) found.push_back(candidate);
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

LoopVerification LoopCloser::verify(const LoopCandidate& candidate, Effort effort,
                                    const KeyFrames& key_frames, const MapFragments& pieces,
                                    const PoseGraph& graph) const {
  const bool glance = effort == Effort::glance;
  VerifierSettings settings = settings_.verifier;
  if (glance) {
    settings.neighbours = std::min(settings.neighbours, kGlanceNeighbours);
    settings.levels = std::min(settings.levels, kGlanceLevels);
  }
  const std::vector<Pose>& poses = graph.poses();
  const Pose expected = poses[candidate.match].inverse() * poses[candidate.query];
  const bool joins = !pieces.joined(candidate.match, candidate.query);
  const bool must_agree = settings.consistency_sigmas > 0.0 && !joins;

  const double travelled = way_between(candidate, key_frames, pieces);
  // Far apart even if drift were at its worst: not worth an ICP.
  if (must_agree && expected.translation().norm() >
                        settings_.scan_context.reach +
                            settings.consistency_sigmas * settings.drift_per_metre * travelled) {
    LoopVerification far;
    far.verdict = Verdict::inconsistent;
    return far;
  }

  // A detector may say how the two scans are turned, the pose graph says where they should be.
  std::vector<Pose> guesses;
  if (candidate.detector != LoopCandidate::Detector::radius && !glance) {
    Pose turned = Pose::Identity();
    turned.linear() = rotation_from_rpy(0.0, 0.0, candidate.yaw);
    guesses.push_back(turned);
  }
  if (candidate.detector != LoopCandidate::Detector::scan_context || glance)
    guesses.push_back(expected);
  LoopVerification result = verify_loop(
      placed_round(candidate.query, settings.query_neighbours, 0, key_frames, pieces, poses),
      placed_round(candidate.match, settings.neighbours, settings.neighbours, key_frames, pieces,
                   poses),
      guesses, range_noise_, settings);

  if (result.verdict == Verdict::accepted && joins && result.overlap < kJoinOverlap)
    result.verdict = Verdict::low_overlap;
  if (result.verdict == Verdict::accepted && must_agree &&
      inconsistency(result.T_match_query, expected, travelled, settings) >
          settings.consistency_sigmas)
    result.verdict = Verdict::inconsistent;
  return result;
}

std::vector<LoopReport> LoopCloser::close(const KeyFrames& key_frames, ScanContext context,
                                          MapFragments& pieces, PoseGraph& graph) {
  const int newest = static_cast<int>(key_frames.size()) - 1;
  const int eligible = count_eligible(key_frames, pieces);
  std::vector<LoopReport> reports = find(key_frames, eligible, context, pieces, graph);
  if (pieces.maps() > 1 || !place_is_known(key_frames.travelled(newest), eligible, graph)) {
    contexts_.add(newest, std::move(context));
    positions_.emplace_back(graph.poses()[newest].translation());
  }
  return reports;
}

PoseEdge LoopCloser::edge_of(const LoopReport& report) const {
  const LoopVerification& verification = report.verification;
  return {report.candidate.match, report.candidate.query, verification.T_match_query,
          loop_covariance(verification.covariance, verification.T_match_query.linear(),
                          graph_settings_)};
}

bool LoopCloser::tells_nothing_new(const PoseEdge& loop, double travelled,
                                   const PoseGraph& graph) const {
  const double chi = graph.chi(loop);
  const bool same_visit = travelled - last_loop_travelled_ < kSameVisit;
  return (same_visit && chi < kNothingNew) ||
         (chi < kDisagreement && ties(loop.from, graph) >= kWellTied);
}

// False when the others contradict the loop, which is taken out again.
bool LoopCloser::add_to(PoseGraph& graph, const PoseEdge& loop, bool joins) {
  const bool agrees = !joins && graph.chi(loop) < kAgreement;
  graph.add_loop(loop);
  const std::size_t loops = graph.loop_edges().size();
  if (agrees && ++waiting_ <= kWaitingShare * static_cast<double>(loops)) return true;
  waiting_ = 0;
  optimise(graph);
  if (graph.loop_chi(loops - 1) <= kContradiction) return true;
  graph.remove_loop(loops - 1);
  optimise(graph);
  return false;
}

LoopCloser::Outcome LoopCloser::judge(LoopReport& report, const KeyFrames& key_frames,
                                      MapFragments& pieces, PoseGraph& graph) {
  const LoopCandidate& candidate = report.candidate;
  const double now = key_frames.travelled(candidate.query);
  const bool joins = !pieces.joined(candidate.match, candidate.query);
  const auto nothing_new = [&](Effort effort) {
    report.verification = verify(candidate, effort, key_frames, pieces, graph);
    return !joins && report.verification.verdict == Verdict::accepted &&
           tells_nothing_new(edge_of(report), now, graph);
  };
  const bool expected = !joins && now - last_loop_travelled_ < kTrusted;
  if ((expected && nothing_new(Effort::glance)) || nothing_new(Effort::full))
    return Outcome::nothing_new;
  if (report.verification.verdict != Verdict::accepted) return Outcome::refused;
  report.added = add_to(graph, edge_of(report), joins);
  if (!report.added) {
    report.verification.verdict = Verdict::contradicted;
    return Outcome::refused;
  }
  if (joins) pieces.join(candidate.match, candidate.query);
  return Outcome::added;
}

// After a loop that told nothing new: twice as long as the time before, longest where many loops
// end.
double LoopCloser::longer_pause(int match, const PoseGraph& graph) const {
  const double share = std::floor(ties(match, graph) / kWellTied);
  const double longest = (1.0 + std::min(share, kMostShares)) * kLongestPause;
  return std::max(settings_.spacing, std::min(2.0 * pause_, longest));
}

std::vector<LoopReport> LoopCloser::find(const KeyFrames& key_frames, int eligible,
                                         const ScanContext& context, MapFragments& pieces,
                                         PoseGraph& graph) {
  std::vector<LoopReport> reports;
  const double now = key_frames.travelled(key_frames.size() - 1);
  const bool pauses = now < next_search_travelled_;
  if (pauses && pieces.maps() == 1) return reports;

  for (const LoopCandidate& candidate : candidates(key_frames, eligible, context, pieces, graph)) {
    if (pauses && pieces.joined(candidate.match, candidate.query)) continue;
    LoopReport& report = reports.emplace_back();
    report.candidate = candidate;
    const Outcome outcome = judge(report, key_frames, pieces, graph);
    if (outcome == Outcome::refused) continue;
    last_loop_travelled_ = now;
    pause(now,
          outcome == Outcome::added ? settings_.spacing : longer_pause(candidate.match, graph));
    return reports;  // one loop for each key frame
  }
  const bool tried = std::ranges::any_of(
      reports, [](const LoopReport& report) { return report.verification.overlap > 0.0; });
  if (!pauses && tried) next_search_travelled_ = now + settings_.spacing;
  return reports;
}

}  // namespace lego_loam_sc
