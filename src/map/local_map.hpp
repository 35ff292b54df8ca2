// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "features/features.hpp"
#include "map/surface_map.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// Maximum number of voxel sizes of a map.
constexpr int kMaxLevels = 6;

/// Cache of the surfaces that the points of one scan were matched with: while the pose converges,
/// most points stay in their blocks. Valid for the same points, first level and state of the map.
struct MatchedSurfaces {
  /// Of one point.
  struct Entry {
    int level = -1;                             ///< the last one searched
    std::array<VoxelKey, kMaxLevels> blocks{};  ///< on each searched level
    Surface surface;                            ///< kind `none` when no level has one
  };
  std::vector<Entry> planes, lines, scattered;
};

/// Correspondences of planar points, edges and scattered points, in this order.
struct MapCorrespondences {
  std::vector<Correspondence> all;
  std::array<std::size_t, 3> end{};  ///< of each set in `all`

  /// Those of one set: 0 planar points, 1 edges, 2 scattered points.
  std::span<const Correspondence> set(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : end[i - 1];
    return std::span(all).subspan(begin, end[i] - begin);
  }
};

/// The correspondence of a point with a surface, whose kind is not `none`.
Correspondence correspondence_with(const Surface& surface, const FeaturePoint& point,
                                   double range_noise);

/// The local map as planes, lines and points: for each of several voxel sizes a surface map of the
/// planar features, one of the edges and one of the scattered points. Used by the mapper and the
/// loop verifier.
class LocalMap {
 public:
  /// The finest voxels measure `voxel_size` (m), those of each further level twice as much. At
  /// ranges where the rows of the sensor, `row_spacing` (rad) apart, are farther from each other
  /// than a block is wide, a block holds one row and no surface: such planar and edge points go to
  /// coarser levels only. 0: all points go to all levels.
  LocalMap(double voxel_size, int levels, double planarity, double row_spacing = 0.0);

  /// Inserts the large sets and the scattered points.
  void insert(const Features& features, const Pose& T_map_points);

  /// Correspondences of the points of these sets with the surface on the finest level that has one,
  /// from `first_level` (0 = finest) on, when it is within `max_distance` (m). `cache` holds the
  /// surfaces found at a previous pose, or is empty; it is updated.
  MapCorrespondences match(const Features& features, const Pose& T_map_points, double max_distance,
                           double range_noise, int first_level, MatchedSurfaces& cache);

  /// Whether the finest voxel of `point` (map frame) holds points.
  bool occupied(const Eigen::Vector3d& point) const;

  /// Removes voxels farther than `radius` (m) from `center`.
  void remove_beyond(const Eigen::Vector3d& center, double radius);
  /// Removes everything.
  void clear();
  /// Number of voxels on the coarsest level, of all sets.
  std::size_t size() const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    for (auto* maps : {&planes_, &lines_, &scattered_})
      for (SurfaceMap& map : *maps) archive(map);
  }

 private:
  std::vector<double> max_range_;   // m, of planar and edge points on each finer level
  std::vector<SurfaceMap> planes_;  // finest first
  std::vector<SurfaceMap> lines_;
  std::vector<SurfaceMap> scattered_;
};

}  // namespace lego_loam_sc
