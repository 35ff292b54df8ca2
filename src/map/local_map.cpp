// SPDX-License-Identifier: BSD-3-Clause
#include "map/local_map.hpp"

#include <span>

namespace lego_loam_sc {
namespace {

// Levels that `reach` does not list take points of all ranges.
bool reaches(std::span<const double> reach, std::size_t level, double range) {
  return level >= reach.size() || range <= reach[level];
}

void insert_into(std::vector<SurfaceMap>& maps, std::span<const double> reach,
                 const std::vector<FeaturePoint>& points, const Pose& T_map_points) {
  std::vector<Eigen::Vector3d> moved;
  std::vector<double> ranges;
  for (std::size_t level = 0; level < maps.size(); ++level) {
    moved.clear();
    ranges.clear();
    for (const FeaturePoint& p : points) {
      const double range = p.position.head<2>().norm();
      if (!reaches(reach, level, range)) continue;
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

// Has the point not left the blocks that it was looked for in?
bool is_where_it_was(const std::vector<SurfaceMap>& maps, const MatchedSurfaces::Entry& entry,
                     const Eigen::Vector3d& point, int first_level) {
  for (int level = first_level; level <= entry.level; ++level)
    if (entry.blocks[level] != kNoBlock && entry.blocks[level] != maps[level].block_of(point))
      return false;
  return entry.level >= 0;
}

// Looks for the surfaces of some points, finest level first. One level is done for all of them
// before the next, so that the memory of many blocks is fetched at a time.
void look_up(std::vector<SurfaceMap>& maps, std::span<const double> reach,
             const std::vector<FeaturePoint>& points, const std::vector<Eigen::Vector3d>& moved,
             int first_level, std::vector<std::uint32_t>& wanted,
             std::vector<MatchedSurfaces::Entry>& entries) {
  for (std::size_t level = first_level; level < maps.size() && !wanted.empty(); ++level) {
    for (const std::uint32_t i : wanted) {
      const bool within = reaches(reach, level, points[i].position.head<2>().norm());
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

void match_with(std::vector<SurfaceMap>& maps, std::span<const double> reach,
                const std::vector<FeaturePoint>& points, const Pose& T_map_points,
                double max_distance, double range_noise, int first_level,
                std::vector<MatchedSurfaces::Entry>& entries,
                std::vector<Correspondence>& correspondences) {
  constexpr std::size_t kAtATime = 64;
  entries.resize(points.size());
  std::vector<Eigen::Vector3d> moved;
  moved.reserve(points.size());
  for (const FeaturePoint& p : points) moved.push_back(T_map_points * p.position.cast<double>());
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!is_where_it_was(maps, entries[i], moved[i], first_level)) wanted.push_back(i);
    if (wanted.size() == kAtATime || i + 1 == points.size())
      look_up(maps, reach, points, moved, first_level, wanted, entries);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Surface& surface = entries[i].surface;
    if (surface.kind == Surface::Kind::none) continue;
    const Eigen::Vector3d point = points[i].position.cast<double>();
    const double weight = 1.0 / (range_noise * range_noise + surface.variance);
    const double range_difference = point.head<2>().norm() - surface.range;
    const Correspondence c{kind_of(surface), point,         surface.mean, surface.direction, weight,
                           range_difference, points[i].age, points[i].row};
    if (distance(c, T_map_points) <= max_distance) correspondences.push_back(c);
  }
}

}  // namespace

LocalMap::LocalMap(double voxel_size, int levels, double planarity, double row_spacing) {
  for (int level = 0; level < levels; ++level) {
    const double size = voxel_size * (1 << level);
    if (level < levels - 1 && row_spacing > 0.0) reach_.push_back(2.0 * size / row_spacing);
    planes_.emplace_back(SurfaceMapSettings{Surface::Kind::plane, size, planarity});
    lines_.emplace_back(SurfaceMapSettings{Surface::Kind::line, size, planarity});
    scattered_.emplace_back(SurfaceMapSettings{Surface::Kind::point, size, planarity});
  }
}

void LocalMap::insert(const Features& features, const Pose& T_map_points) {
  insert_into(planes_, reach_, features.planars_large, T_map_points);
  insert_into(lines_, reach_, features.edges_large, T_map_points);
  insert_into(scattered_, {}, features.scattered, T_map_points);
}

std::vector<Correspondence> LocalMap::match(const Features& features, const Pose& T_map_points,
                                            double max_distance, double range_noise,
                                            int first_level, MatchedSurfaces& last) {
  std::vector<Correspondence> correspondences;
  match_with(planes_, reach_, features.planars_large, T_map_points, max_distance, range_noise,
             first_level, last.planes, correspondences);
  match_with(lines_, reach_, features.edges_large, T_map_points, max_distance, range_noise,
             first_level, last.lines, correspondences);
  match_with(scattered_, {}, features.scattered, T_map_points, max_distance, range_noise,
             first_level, last.scattered, correspondences);
  return correspondences;
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
