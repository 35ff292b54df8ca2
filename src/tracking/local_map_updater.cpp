// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/local_map_updater.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace lego_loam_sc {
namespace {

// A key frame that has moved by kMoved, m, here or at the distance kArm, m, blurs the surfaces of
// the map: rebuild.
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
  pending_.clear();
}

bool LocalMapUpdater::on_graph_update(const Correction& correction, const KeyFrames& key_frames,
                                      Mapper& mapper) {
  const std::vector<Pose>& T_map_key = correction.T_map_key;
  if (!correction.accepted) {
    for (Inserted& entry : pending_) entry.T_map_key = T_map_key[entry.key_frame];
    return false;
  }
  const bool moved = has_moved(T_map_key);
  if (moved) {
    clear();
    mapper.clear();
  }
  pending_ = missing(correction);
  if (moved) insert_next(kAtOnce, key_frames, mapper);
  return moved;
}

void LocalMapUpdater::insert_pending(const KeyFrames& key_frames, Mapper& mapper) {
  insert_next(kWithEachScan, key_frames, mapper);
}

// Key frames near the newest one that the map lacks: the first of each cell, counted from the
// nearest, which comes last.
std::vector<LocalMapUpdater::Inserted> LocalMapUpdater::missing(
    const Correction& correction) const {
  const std::vector<Pose>& T_map_key = correction.T_map_key;
  const int last = static_cast<int>(T_map_key.size()) - 1;
  std::vector<std::pair<double, int>> near = {{0.0, last}};
  for (const int k : correction.places) {
    const double away = distance(T_map_key[k], T_map_key[last]);
    if (away <= kNear * radius_) near.emplace_back(away, k);
  }
  std::sort(near.begin(), near.end());
  std::set<Cell> taken;
  std::set<int> inserted;
  for (const auto& [cell, entry] : in_map_) {
    taken.insert(cell);
    inserted.insert(entry.key_frame);
  }
  std::vector<Inserted> result;
  for (const auto& [away, k] : near)
    if (!inserted.contains(k) && taken.insert(cell_of(T_map_key[k])).second)
      result.push_back({k, T_map_key[k]});
  std::reverse(result.begin(), result.end());
  return result;
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

void LocalMapUpdater::insert_next(int count, const KeyFrames& key_frames, Mapper& mapper) {
  for (; count > 0 && !pending_.empty(); --count) {
    const Inserted next = pending_.back();
    pending_.pop_back();
    mapper.insert(key_frames.features(next.key_frame), next.T_map_key);
    in_map_.insert_or_assign(cell_of(next.T_map_key), next);
  }
}

}  // namespace lego_loam_sc
