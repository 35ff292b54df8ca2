// SPDX-License-Identifier: BSD-3-Clause
#include "map/local_map.hpp"

#include <span>

namespace lego_loam_sc {
namespace {

// Whether a level takes a point at this range; levels beyond `max_range` take all.
bool takes(std::span<const double> max_range, std::size_t level, double range) {
  return level >= max_range.size() || range <= max_range[level];
}

// With `thin` a level takes one of two points of the finer one: its voxels are eight times larger.
void insert_into(std::vector<SurfaceMap>& maps, std::span<const double> max_range,
                 const std::vector<FeaturePoint>& points, const Pose& T_map_points,
                 bool thin = false) {
  std::vector<Eigen::Vector3d> moved;
  std::vector<double> ranges;
  for (std::size_t level = 0; level < maps.size(); ++level) {
    moved.clear();
    ranges.clear();
    const std::size_t step = thin ? std::size_t{1} << level : 1;
    for (std::size_t i = 0; i < points.size(); i += step) {
      const FeaturePoint& p = points[i];
      const double range = p.position.head<2>().norm();
      if (!takes(max_range, level, range)) continue;
      moved.push_back(T_map_points * p.position.cast<double>());
      ranges.push_back(range);
    }
    maps[level].insert(moved, ranges);
  }
}

Correspondence::Kind kind_of(const Surface& surface) {
  switch (surface.kind) {
    case Surface::Kind::plane: return Correspondence::Kind::plane;
    case Surface::Kind::line: return Correspondence::Kind::line;
    default: return Correspondence::Kind::point;
  }
}

// Whether the point is still in the blocks that were searched for it.
bool is_in_same_blocks(const std::vector<SurfaceMap>& maps, const MatchedSurfaces::Entry& entry,
                       const Eigen::Vector3d& point, int first_level) {
  for (int level = first_level; level <= entry.level; ++level)
    if (entry.blocks[level] != kNoBlock && entry.blocks[level] != maps[level].block_of(point))
      return false;
  return entry.level >= 0;
}

// Finds the surfaces of the `wanted` points, finest level first. Each level is searched for all of
// them before the next, so that many blocks are prefetched at a time.
void look_up(std::vector<SurfaceMap>& maps, std::span<const double> max_range,
             const std::vector<FeaturePoint>& points, const std::vector<Eigen::Vector3d>& moved,
             int first_level, std::vector<std::uint32_t>& wanted,
             std::vector<MatchedSurfaces::Entry>& entries) {
  for (std::size_t level = first_level; level < maps.size() && !wanted.empty(); ++level) {
    for (const std::uint32_t i : wanted) {
      const bool within = takes(max_range, level, points[i].position.head<2>().norm());
      VoxelKey& block = entries[i].blocks[level];
      block = within ? maps[level].block_of(moved[i]) : kNoBlock;
      maps[level].prefetch(block);
    }
    for (const std::uint32_t i : wanted) maps[level].prefetch_value(entries[i].blocks[level]);
    std::erase_if(wanted, [&](std::uint32_t i) {
      entries[i].level = static_cast<int>(level);
      entries[i].surface = maps[level].surface_of(entries[i].blocks[level]);
      return entries[i].surface.kind != Surface::Kind::none;
    });
  }
  wanted.clear();
}

void match_with(std::vector<SurfaceMap>& maps, std::span<const double> max_range,
                const std::vector<FeaturePoint>& points, const Pose& T_map_points,
                double max_distance, double range_noise, int first_level,
                std::vector<MatchedSurfaces::Entry>& entries,
                std::vector<Correspondence>& correspondences) {
  constexpr std::size_t kBatch = 64;
  entries.resize(points.size());
  std::vector<Eigen::Vector3d> moved;
  moved.reserve(points.size());
  for (const FeaturePoint& p : points) moved.push_back(T_map_points * p.position.cast<double>());
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!is_in_same_blocks(maps, entries[i], moved[i], first_level)) wanted.push_back(i);
    if (wanted.size() == kBatch || i + 1 == points.size())
      look_up(maps, max_range, points, moved, first_level, wanted, entries);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Surface& surface = entries[i].surface;
    if (surface.kind == Surface::Kind::none) continue;
    const Correspondence c = correspondence_with(surface, points[i], range_noise);
    if (distance(c, T_map_points) <= max_distance) correspondences.push_back(c);
  }
}

}  // namespace

Correspondence correspondence_with(const Surface& surface, const FeaturePoint& feature,
                                   double range_noise) {
  const Eigen::Vector3d point = feature.position.cast<double>();
  return {kind_of(surface),
          point,
          surface.mean,
          surface.direction,
          1.0 / (range_noise * range_noise + surface.variance),
          point.head<2>().norm() - surface.range,
          feature.time,
          feature.row};
}

LocalMap::LocalMap(double voxel_size, int levels, double planarity, double row_spacing) {
  for (int level = 0; level < levels; ++level) {
    const double size = voxel_size * (1 << level);
    const double max_range = row_spacing > 0.0 ? 2.0 * size / row_spacing : 0.0;
    if (level < levels - 1 && row_spacing > 0.0) max_range_.push_back(max_range);
    planes_.emplace_back(SurfaceMapSettings{Surface::Kind::plane, size, planarity});
    lines_.emplace_back(SurfaceMapSettings{Surface::Kind::line, size, planarity});
    scattered_.emplace_back(SurfaceMapSettings{Surface::Kind::point, size, planarity, max_range});
  }
}

void LocalMap::insert(const Features& features, const Pose& T_map_points) {
  insert_into(planes_, max_range_, features.planars_large, T_map_points);
  insert_into(lines_, max_range_, features.edges_large, T_map_points);
  insert_into(scattered_, {}, features.scattered, T_map_points, true);
}

MapCorrespondences LocalMap::match(const Features& features, const Pose& T_map_points,
                                   double max_distance, double range_noise, int first_level,
                                   MatchedSurfaces& cache) {
  MapCorrespondences found;
  match_with(planes_, max_range_, features.planars_large, T_map_points, max_distance, range_noise,
             first_level, cache.planes, found.all);
  found.end[0] = found.all.size();
  match_with(lines_, max_range_, features.edges_large, T_map_points, max_distance, range_noise,
             first_level, cache.lines, found.all);
  found.end[1] = found.all.size();
  match_with(scattered_, {}, features.scattered, T_map_points, max_distance, range_noise,
             first_level, cache.scattered, found.all);
  found.end[2] = found.all.size();
  return found;
}

bool LocalMap::occupied(const Eigen::Vector3d& point) const {
  return planes_.front().occupied(point) || lines_.front().occupied(point) ||
         scattered_.front().occupied(point);
}

void LocalMap::remove_beyond(const Eigen::Vector3d& center, double radius) {
  for (auto* maps : {&planes_, &lines_, &scattered_})
    for (SurfaceMap& map : *maps) map.remove_beyond(center, radius);
}

void LocalMap::clear() {
  for (auto* maps : {&planes_, &lines_, &scattered_})
    for (SurfaceMap& map : *maps) map.clear();
}

std::size_t LocalMap::size() const {
  return planes_.back().size() + lines_.back().size() + scattered_.back().size();
}

}  // namespace lego_loam_sc
