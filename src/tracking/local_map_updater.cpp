// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/local_map_updater.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace lego_loam_sc {
namespace {

// A key frame that has moved by this much blurs the surfaces of the map: m, and m at this distance.
constexpr double kMoved = 0.03;
constexpr double kArm = 10.0;
// Key frames that make a map to go on with, and those that follow with each scan.
constexpr int kAtOnce = 12;
constexpr int kWithEachScan = 3;

// m; of the key frames in a cell of this size one is enough, and of the radius of the local map
// this share. Whoever drives the same ways all day would otherwise have very many of them put in.
constexpr double kCell = 8.0;
constexpr double kNear = 0.5;

double distance(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm();
}

}  // namespace

void LocalMapUpdater::add(int key_frame, const Pose& T_map_key) {
  std::erase_if(in_map_, [&](const auto& entry) {
    return distance(entry.second.T_map_key, T_map_key) > radius_;
  });
  in_map_.insert_or_assign(cell_of(T_map_key), Inserted{key_frame, T_map_key});
}

void LocalMapUpdater::clear() {
  in_map_.clear();
  missing_.clear();
}

bool LocalMapUpdater::follow(std::span<const Pose> T_map_key, std::span<const int> places,
                       const MapFragments& pieces, const KeyFrames& key_frames, Mapper& mapper) {
  const bool moved = has_moved(T_map_key);
  if (moved) {
    clear();
    mapper.clear();
  }
  missing_.clear();
  const int last = static_cast<int>(T_map_key.size()) - 1;
  std::vector<std::pair<double, int>> near = {{0.0, last}};
  for (const int k : places) {
    const double away = distance(T_map_key[k], T_map_key[last]);
    if (away <= kNear * radius_ && pieces.joined(k, last)) near.emplace_back(away, k);
  }
  std::sort(near.begin(), near.end());
  std::set<Cell> taken;
  std::set<int> inserted;
  for (const auto& [cell, entry] : in_map_) {
    taken.insert(cell);
    inserted.insert(entry.key_frame);
  }
  for (const auto& [away, k] : near)
    if (!inserted.contains(k) && taken.insert(cell_of(T_map_key[k])).second) missing_.push_back(k);
  std::reverse(missing_.begin(), missing_.end());
  if (moved) put_in(kAtOnce, T_map_key, key_frames, mapper);
  return moved;
}

void LocalMapUpdater::go_on(std::span<const Pose> T_map_key, const KeyFrames& key_frames,
                      Mapper& mapper) {
  put_in(kWithEachScan, T_map_key, key_frames, mapper);
}

LocalMapUpdater::Cell LocalMapUpdater::cell_of(const Pose& T_map_key) {
  const Eigen::Vector3d position = T_map_key.translation();
  Cell cell;
  for (int i = 0; i < 3; ++i) cell[i] = static_cast<int>(std::floor(position[i] / kCell));
  return cell;
}

bool LocalMapUpdater::has_moved(std::span<const Pose> T_map_key) const {
  return std::ranges::any_of(in_map_, [&](const auto& entry) {
    const auto& [key_frame, T_map_then] = entry.second;
    const Pose change = T_map_then.inverse() * T_map_key[key_frame];
    return change.translation().norm() + kArm * rotation_angle(change) > kMoved;
  });
}

void LocalMapUpdater::put_in(int count, std::span<const Pose> T_map_key, const KeyFrames& key_frames,
                       Mapper& mapper) {
  for (; count > 0 && !missing_.empty(); --count) {
    const int k = missing_.back();
    missing_.pop_back();
    mapper.insert(key_frames.features(k), T_map_key[k]);
    in_map_.insert_or_assign(cell_of(T_map_key[k]), Inserted{k, T_map_key[k]});
  }
}

}  // namespace lego_loam_sc
