// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/local_map.hpp"

#include <limits>

namespace lego_loam_sc {
namespace {

void insert_into(std::vector<SurfaceMap>& maps, const std::vector<double>& reach,
                 const std::vector<FeaturePoint>& points, const Pose& T_map_points,
                 int first_level) {
  std::vector<Eigen::Vector3d> moved;
  std::vector<double> ranges;
  for (std::size_t level = first_level; level < maps.size(); ++level) {
    moved.clear();
    ranges.clear();
    for (const FeaturePoint& p : points) {
      const double range = p.position.head<2>().norm();
      if (range > reach[level]) continue;
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

void match_with(std::vector<SurfaceMap>& maps, const std::vector<double>& reach,
                const std::vector<FeaturePoint>& points, const Pose& T_map_points,
                double max_distance, double range_noise, int first_level,
                std::vector<Correspondence>& correspondences) {
  for (const FeaturePoint& p : points) {
    const Eigen::Vector3d point = p.position.cast<double>();
    const Eigen::Vector3d moved = T_map_points * point;
    const double range = point.head<2>().norm();
    for (std::size_t level = first_level; level < maps.size(); ++level) {
      if (range > reach[level]) continue;
      const Surface& surface = maps[level].surface_at(moved);
      if (surface.kind == Surface::Kind::none) continue;
      const double weight = 1.0 / (range_noise * range_noise + surface.variance);
      const double range_difference = range - surface.range;
      const Correspondence c{kind_of(surface), point, surface.mean, surface.direction, weight,
                             range_difference, p.age};
      if (distance(c, T_map_points) <= max_distance) correspondences.push_back(c);
      break;
    }
  }
}

}  // namespace

LocalMap::LocalMap(double voxel_size, int levels, double planarity, double row_spacing) {
  for (int level = 0; level < levels; ++level) {
    const double size = voxel_size * (1 << level);
    const bool coarsest = level == levels - 1;
    reach_.push_back(coarsest || row_spacing == 0.0 ? std::numeric_limits<double>::infinity()
                                                    : 2.0 * size / row_spacing);
    planes_.emplace_back(SurfaceMapSettings{Surface::Kind::plane, size, planarity});
    lines_.emplace_back(SurfaceMapSettings{Surface::Kind::line, size, planarity});
    everywhere_.push_back(std::numeric_limits<double>::infinity());
    scattered_.emplace_back(SurfaceMapSettings{Surface::Kind::point, size, planarity});
  }
}

void LocalMap::insert(const Features& features, const Pose& T_map_points, int first_level) {
  insert_into(planes_, reach_, features.planars_large, T_map_points, first_level);
  insert_into(lines_, reach_, features.edges_large, T_map_points, first_level);
  insert_into(scattered_, everywhere_, features.scattered, T_map_points, first_level);
}

std::vector<Correspondence> LocalMap::match(const Features& features, const Pose& T_map_points,
                                            double max_distance, double range_noise,
                                            int first_level) {
  std::vector<Correspondence> correspondences;
  match_with(planes_, reach_, features.planars_large, T_map_points, max_distance, range_noise,
             first_level, correspondences);
  match_with(lines_, reach_, features.edges_large, T_map_points, max_distance, range_noise,
             first_level, correspondences);
  match_with(scattered_, everywhere_, features.scattered, T_map_points, max_distance, range_noise,
             first_level, correspondences);
  return correspondences;
}

bool LocalMap::occupied(const Eigen::Vector3d& point) {
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
