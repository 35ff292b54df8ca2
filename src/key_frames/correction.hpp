// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pose.hpp"

namespace lego_loam_sc {

/// What the back end tells the tracker when loops have changed the pose graph.
struct Correction {
  std::vector<Pose> T_map_key;  ///< of every key frame so far
  /// Whether a loop at the newest key frame was accepted. If not, one was taken out again: the
  /// poses are news, but the local map stays as it is.
  bool accepted = false;
  /// Key frames that may be put into the local map: one for each place of the newest one's map,
  /// ascending.
  std::vector<int> places;
};

}  // namespace lego_loam_sc
