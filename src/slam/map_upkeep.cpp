// SPDX-License-Identifier: BSD-3-Clause
#include "slam/map_upkeep.hpp"

#include <algorithm>
#include <array>
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

// m; of the key frames in a cell of this size one is enough. Whoever drives the same way all day
// would otherwise have all of them put in again and again.
constexpr double kCell = 1.0;

double distance(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm();
}

using CellIndex = std::array<int, 3>;

CellIndex cell_of(const Pose& pose) {
  CellIndex cell;
  for (int i = 0; i < 3; ++i) cell[i] = static_cast<int>(std::floor(pose.translation()[i] / kCell));
  return cell;
}

}  // namespace

void MapUpkeep::add(const Pose& T_map_key) {
  for (std::optional<Pose>& other : in_map_)
    if (other && distance(*other, T_map_key) > radius_) other.reset();
  in_map_.push_back(T_map_key);
}

void MapUpkeep::clear() {
  std::fill(in_map_.begin(), in_map_.end(), std::nullopt);
  missing_.clear();
}

bool MapUpkeep::follow(std::span<const Pose> T_map_key, const Pieces& pieces,
                       const KeyFrames& key_frames, Mapper& mapper) {
  const bool moved = has_moved(T_map_key);
  if (moved) {
    clear();
    mapper.clear();
  }
  missing_.clear();
  const int last = static_cast<int>(T_map_key.size()) - 1;
  std::vector<std::pair<double, int>> near;
  for (int k = 0; k <= last; ++k) {
    const double away = distance(T_map_key[k], T_map_key[last]);
    if (away <= radius_ && !in_map_[k] && pieces.joined(k, last)) near.emplace_back(away, k);
  }
  std::sort(near.begin(), near.end());
  std::set<CellIndex> taken;
  for (const std::optional<Pose>& pose : in_map_)
    if (pose) taken.insert(cell_of(*pose));
  for (const auto& [away, k] : near)
    if (taken.insert(cell_of(T_map_key[k])).second) missing_.push_back(k);
  std::reverse(missing_.begin(), missing_.end());
  if (moved) put_in(kAtOnce, T_map_key, key_frames, mapper);
  return moved;
}

void MapUpkeep::go_on(std::span<const Pose> T_map_key, const KeyFrames& key_frames,
                      Mapper& mapper) {
  put_in(kWithEachScan, T_map_key, key_frames, mapper);
}

bool MapUpkeep::has_moved(std::span<const Pose> T_map_key) const {
  for (std::size_t k = 0; k < in_map_.size(); ++k) {
    if (!in_map_[k]) continue;
    const Pose change = in_map_[k]->inverse() * T_map_key[k];
    if (change.translation().norm() + kArm * rotation_angle(change) > kMoved) return true;
  }
  return false;
}

void MapUpkeep::put_in(int count, std::span<const Pose> T_map_key, const KeyFrames& key_frames,
                       Mapper& mapper) {
  for (; count > 0 && !missing_.empty(); --count) {
    const int k = missing_.back();
    missing_.pop_back();
    mapper.insert(key_frames.features(k), T_map_key[k]);
    in_map_[k] = T_map_key[k];
  }
}

}  // namespace lego_loam_sc
