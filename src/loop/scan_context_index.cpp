// SPDX-License-Identifier: BSD-3-Clause
#include "loop/scan_context_index.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

namespace lego_loam_sc {
namespace {

// Keys lie in blocks of eight key frames, ring by ring, so that eight distances are computed at
// once by vector instructions.
constexpr std::size_t kBlock = 8;

using BlockDistances = std::array<float, kBlock>;

BlockDistances squared_distances(const float* block, const std::vector<float>& key) {
  BlockDistances sums = {};
  for (std::size_t ring = 0; ring < key.size(); ++ring) {
    for (std::size_t lane = 0; lane < kBlock; ++lane) {
      const float difference = block[ring * kBlock + lane] - key[ring];
      sums[lane] += difference * difference;
    }
  }
  return sums;
}

// The places 0 to eligible - 1 with the nearest keys, nearest first.
std::vector<int> nearest_keys(const std::vector<float>& blocks, const std::vector<float>& key,
                              std::size_t eligible, std::size_t count) {
  std::vector<std::pair<float, int>> nearest;  // ascending; equal distances by place
  float farthest = std::numeric_limits<float>::infinity();
  for (std::size_t first = 0; first < eligible; first += kBlock) {
    const BlockDistances distances = squared_distances(blocks.data() + first * key.size(), key);
    for (std::size_t lane = 0; lane < std::min(kBlock, eligible - first); ++lane) {
      if (!(distances[lane] < farthest)) continue;
      const std::pair entry(distances[lane], static_cast<int>(first + lane));
      nearest.insert(std::upper_bound(nearest.begin(), nearest.end(), entry), entry);
      if (nearest.size() > count) nearest.pop_back();
      if (nearest.size() == count) farthest = nearest.back().first;
    }
  }
  std::vector<int> places;
  for (const auto& [distance, place] : nearest) places.push_back(place);
  return places;
}

}  // namespace

ScanContextIndex::ScanContextIndex(const ScanContextSettings& settings) : settings_(settings) {}

void ScanContextIndex::add(int key_frame, ScanContext context) {
  if (context.rings != settings_.rings || context.sectors != settings_.sectors)
    throw std::invalid_argument(
        "scan context has another number of rings or sectors than the index");
  const std::size_t lane = contexts_.size() % kBlock;
  const std::size_t block = contexts_.size() / kBlock * kBlock * context.ring_key.size();
  if (lane == 0) ring_keys_.resize(block + kBlock * context.ring_key.size(), 0.0f);
  for (std::size_t ring = 0; ring < context.ring_key.size(); ++ring)
    ring_keys_[block + ring * kBlock + lane] = context.ring_key[ring];
  key_frames_.push_back(key_frame);
  contexts_.push_back(std::move(context));
}

std::span<const int> ScanContextIndex::key_frames_before(int eligible) const {
  return {key_frames_.begin(), std::lower_bound(key_frames_.begin(), key_frames_.end(), eligible)};
}

std::vector<LoopCandidate> ScanContextIndex::search(int query, const ScanContext& context,
                                                    int eligible) const {
  const std::size_t count = key_frames_before(eligible).size();
  std::vector<LoopCandidate> candidates;
  for (const int place : nearest_keys(ring_keys_, context.ring_key, count, settings_.candidates)) {
    const ScanContextMatch match = compare(context, contexts_[place]);
    if (match.distance < settings_.threshold)  // equation (8)
      candidates.push_back({query, key_frames_[place], LoopCandidate::Detector::scan_context,
                            match.distance, match.yaw});
  }
  std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return std::pair(a.distance, a.match) < std::pair(b.distance, b.match);
  });
  return candidates;
}

}  // namespace lego_loam_sc
