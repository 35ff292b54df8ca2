// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {

/// The pieces of the drive. Where the way was lost, key frames go on in a new piece; the pose graph
/// has it where the prediction ended, which may be wrong by any distance, until a loop joins it
/// with an earlier one. MapFragments that loops have joined are one map.
class MapFragments {
 public:
  /// Begins a piece with this key frame; those before belong to earlier pieces, for good.
  void begin(int key_frame);

  bool same(int a, int b) const { return piece_of(a) == piece_of(b); }
  /// Whether the pose graph knows how the key frames lie to each other.
  bool joined(int a, int b) const { return map_[piece_of(a)] == map_[piece_of(b)]; }

  /// A loop between the two has been found.
  void join(int a, int b);

  int count() const { return static_cast<int>(first_.size()); }
  /// Number of maps that no loop joins.
  int maps() const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(first_, map_);
  }

 private:
  int piece_of(int key_frame) const;

  std::vector<int> first_ = {0};  // key frame of each piece
  std::vector<int> map_ = {0};    // of each piece: the number of the first piece of its map
};

/// Of the edge to the first key frame of a piece, in the convention of PoseEdge: so wide that any
/// loop outweighs the prediction, and no wider, since the solver squares it.
Matrix6 broken_covariance();

}  // namespace lego_loam_sc
