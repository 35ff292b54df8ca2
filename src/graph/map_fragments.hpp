// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {

/// The fragments of the drive. Where tracking was lost, a new fragment begins at the predicted
/// pose, which may be wrong by any distance: the relative poses of fragments are unconstrained
/// until a loop joins them. Fragments that loops have joined are one map.
class MapFragments {
 public:
  /// Begins a fragment with this key frame; those before belong to earlier ones, for good.
  void begin(int key_frame);

  /// Whether two key frames belong to one fragment.
  bool same(int a, int b) const { return fragment_of(a) == fragment_of(b); }
  /// Whether they belong to one map: the pose graph knows their relative pose.
  bool joined(int a, int b) const { return map_[fragment_of(a)] == map_[fragment_of(b)]; }

  /// A loop between the two has been found.
  void join(int a, int b);

  int count() const { return static_cast<int>(first_.size()); }  ///< of fragments
  /// Number of maps that no loop joins.
  int maps() const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(first_, map_);
  }

 private:
  int fragment_of(int key_frame) const;

  std::vector<int> first_ = {0};  // key frame of each fragment
  std::vector<int> map_ = {0};    // of each fragment: number of the first fragment of its map
};

/// Covariance of the edge to the first key frame of a fragment, in the convention of PoseEdge: so
/// wide that any loop outweighs the prediction, and no wider, since the solver squares it.
Matrix6 unconstrained_covariance();

}  // namespace lego_loam_sc
