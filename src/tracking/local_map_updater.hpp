// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "key_frames/correction.hpp"
#include "key_frames/key_frames.hpp"
#include "mapping/mapper.hpp"

namespace lego_loam_sc {

/// Keeps the local map in step with the pose graph. A loop moves key frames and may bring others
/// near that the map has forgotten. When a key frame in the map has moved so far that its surfaces
/// would blur, the map is rebuilt from the key frames; otherwise the missing ones are added. Either
/// takes many key frames: the nearest are inserted at once and the others a few with each scan, so
/// that no scan waits for all of them.
class LocalMapUpdater {
 public:
  /// `radius` of the local map, m.
  explicit LocalMapUpdater(double radius) : radius_(radius) {}

  /// The next key frame, whose scan the mapper has in the map at this pose.
  void add(int key_frame, const Pose& T_map_key);

  /// The mapper has forgotten everything.
  void clear();

  /// Takes what the back end says. True when the map is rebuilt: then the last key frame is where
  /// the graph has it, otherwise where the mapper has it.
  bool on_graph_update(const Correction& correction, const KeyFrames& key_frames, Mapper& mapper);

  /// With each scan: puts in some of those that are still missing.
  void insert_pending(const KeyFrames& key_frames, Mapper& mapper);

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(in_map_, pending_);
  }

 private:
  struct Inserted {
    int key_frame = 0;
    Pose T_map_key = Pose::Identity();

    template <class Archive>
    void state(Archive& archive) {
      archive(key_frame, T_map_key);
    }
  };
  using Cell = std::array<int, 3>;

  static Cell cell_of(const Pose& T_map_key);
  bool has_moved(std::span<const Pose> T_map_key) const;
  std::vector<Inserted> missing(const Correction& correction) const;
  void insert_next(int count, const KeyFrames& key_frames, Mapper& mapper);

  double radius_;
  std::map<Cell, Inserted> in_map_;  // of each cell the last, where the map has it
  std::vector<Inserted> pending_;    // to be put in, the nearest last
};

}  // namespace lego_loam_sc
