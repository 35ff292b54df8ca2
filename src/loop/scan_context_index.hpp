// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "loop/loop_candidate.hpp"
#include "loop/scan_context.hpp"
#include "loop/settings.hpp"

namespace lego_loam_sc {

/// The scan contexts of places, searched by ring key: paper 2.3 (5c). The search goes
/// through all keys: it is exact, finds a new key frame at once where a kd-tree must be rebuilt,
/// and takes about a millisecond for 100,000 key frames.
class ScanContextIndex {
 public:
  /// Without places.
  explicit ScanContextIndex(const ScanContextSettings& settings);

  /// Describes a key frame; in ascending order, not necessarily all.
  void add(int key_frame, ScanContext context);

  /// The key frames that were described.
  std::span<const int> key_frames() const { return key_frames_; }
  /// Those of them before `eligible`.
  std::span<const int> key_frames_before(int eligible) const;

  /// Loop candidates of key frame `query` among those before `eligible`: those of the
  /// `settings.candidates` nearest ring keys whose D is below `settings.threshold`, best first, so
  /// that the first is c* of equation (8). Of equal ones the earlier key frame comes first.
  std::vector<LoopCandidate> search(int query, const ScanContext& context, int eligible) const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive.grown(key_frames_);
    archive.grown(contexts_);
    archive(ring_keys_);
  }

 private:
  ScanContextSettings settings_;
  std::vector<int> key_frames_;  // ascending
  std::vector<ScanContext> contexts_;
  std::vector<float> ring_keys_;  // see nearest_keys
};

}  // namespace lego_loam_sc
