// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "graph/map_fragments.hpp"
#include "key_frames/key_frames.hpp"
#include "mapping/mapper.hpp"

namespace lego_loam_sc {

/// Keeps the local map in step with the pose graph. A loop moves key frames and may bring others
/// near that the map has forgotten. When one that is in the map has moved by more than its surfaces
/// bear, the map is drawn anew from the key frames; when not, only those where it has none are
/// added and the mapper goes on where it is. Either takes many key frames: the nearest are put in
/// at once and the others a few with each scan, so that no scan has to wait for all of them.
class LocalMapUpdater {
 public:
  /// `radius` of the local map, m.
  explicit LocalMapUpdater(double radius) : radius_(radius) {}

  /// The next key frame, whose scan the mapper has in the map at this pose.
  void add(int key_frame, const Pose& T_map_key);

  /// The mapper has forgotten everything.
  void clear();

  /// After the pose graph has moved; `places` are the key frames that may be put in. True when the
  /// map is drawn anew: then the last key frame is where the graph has it, otherwise where the
  /// mapper has it.
  bool follow(std::span<const Pose> T_map_key, std::span<const int> places, const MapFragments& pieces,
              const KeyFrames& key_frames, Mapper& mapper);

  /// With each scan: puts in some of those that are still missing.
  void go_on(std::span<const Pose> T_map_key, const KeyFrames& key_frames, Mapper& mapper);

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(in_map_, missing_);
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
  void put_in(int count, std::span<const Pose> T_map_key, const KeyFrames& key_frames,
              Mapper& mapper);

  double radius_;
  std::map<Cell, Inserted> in_map_;  // of each cell the last, where the map has it
  std::vector<int> missing_;         // to be put in, the nearest last
};

}  // namespace lego_loam_sc
