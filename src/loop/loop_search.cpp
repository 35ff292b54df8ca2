// SPDX-License-Identifier: BSD-3-Clause
#include "loop/loop_search.hpp"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/time.hpp"
#include "loop/radius_search.hpp"

namespace lego_loam_sc {
namespace {

// m; visits this near to each other are at the same place.
constexpr double kSamePlace = 2.0;

}  // namespace

int count_eligible(const DriveView& drive, const LoopSettings& settings) {
  const KeyFrames& key_frames = drive.key_frames;
  const int query = drive.newest();
  const auto numbers = std::views::iota(0, query);
  return *std::ranges::partition_point(numbers, [&](int k) {
    const double age = seconds(key_frames.reference_ns(query) - key_frames.reference_ns(k));
    return !drive.fragments.same(k, query) ||
           (key_frames.travelled(query) - key_frames.travelled(k) >= settings.min_travel &&
            age >= settings.min_seconds);
  });
}

LoopSearch::LoopSearch(const LoopSettings& settings, LoopDetector detector)
    : settings_(settings), detector_(std::move(detector)), contexts_(settings.scan_context) {}

std::vector<LoopCandidate> LoopSearch::candidates(const DriveView& drive, int eligible,
                                                  const ScanContext& context) const {
  std::vector<LoopCandidate> found;
  if (settings_.scan_context.enabled) found = by_scan_context(drive, eligible, context);
  if (settings_.radius_search.enabled) {
    for (const LoopCandidate& candidate : by_distance(drive, eligible, settings_.radius_search))
      if (!drive.joins_maps(candidate.match)) found.push_back(candidate);
  }
  if (detector_ && eligible > 0)
    std::ranges::copy(by_detector(drive, eligible), std::back_inserter(found));
  return found;
}

// c* of equation (8), and a few more that would join maps: there is no pose graph to contradict
// one.
std::vector<LoopCandidate> LoopSearch::by_scan_context(const DriveView& drive, int eligible,
                                                       const ScanContext& context) const {
  std::vector<LoopCandidate> found;
  for (const LoopCandidate& candidate : contexts_.search(drive.newest(), context, eligible)) {
    const bool best = found.empty();
    const bool joins = drive.joins_maps(candidate.match);
    if (best || (joins && std::ssize(found) < settings_.join_candidates))
      found.push_back(candidate);
  }
  return found;
}

// LeGO-LOAM's own detector, 2.1.
std::vector<LoopCandidate> LoopSearch::by_distance(const DriveView& drive, int eligible,
                                                   const RadiusSearchSettings& settings) const {
  return search_radius(drive.newest(), drive.graph.poses().back().translation(),
                       contexts_.key_frames_before(eligible), positions_, settings);
}

std::vector<LoopCandidate> LoopSearch::by_detector(const DriveView& drive, int eligible) const {
  std::vector<LoopCandidate> found = detector_({drive.key_frames, drive.graph.poses(), eligible});
  for (LoopCandidate& candidate : found) {
    if (candidate.match < 0 || candidate.match >= eligible)
      throw std::invalid_argument("the loop detector gave key frame " +
                                  std::to_string(candidate.match) + ", only those from 0 to " +
                                  std::to_string(eligible - 1) + " are eligible");
    candidate.query = drive.newest();
    candidate.detector = LoopCandidate::Detector::custom;
  }
  return found;
}

bool LoopSearch::has_place(const DriveView& drive, int eligible) const {
  RadiusSearchSettings same_place;
  same_place.radius = kSamePlace;
  same_place.candidates = 1;
  return !by_distance(drive, eligible, same_place).empty();
}

void LoopSearch::add_place(const DriveView& drive, ScanContext context) {
  contexts_.add(drive.newest(), std::move(context));
  positions_.emplace_back(drive.graph.poses()[drive.newest()].translation());
}

void LoopSearch::update_positions(const PoseGraph& graph) {
  for (std::size_t i = 0; i < positions_.size(); ++i)
    positions_[i] = graph.poses()[places()[i]].translation();
}

}  // namespace lego_loam_sc
