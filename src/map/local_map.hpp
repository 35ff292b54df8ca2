// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "core/pose.hpp"
#include "features/features.hpp"
#include "map/surface_map.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// Voxel sizes that a map may have.
constexpr int kMaxLevels = 6;

/// What the points of one scan were matched with. While its pose settles most points stay in their
/// blocks and need not be looked up again. Good for the same points, first level and state of the
/// map.
struct MatchedSurfaces {
  struct Entry {
    int level = -1;                             ///< the last that was looked at
    std::array<VoxelKey, kMaxLevels> blocks{};  ///< on each level from the first to that
    Surface surface;                            ///< none when no level has one
  };
  std::vector<Entry> planes, lines, scattered;
};

/// The surroundings as planes, lines and places: a surface map of the planar features, one of the
/// edges and one of the scattered points for each of several voxel sizes. Serves the mapper and the
/// verifier of loops.
class LocalMap {
 public:
  /// The finest voxels measure `voxel_size` (m), each of the `levels` twice the one before. Where
  /// the rows of the sensor, `row_spacing` (rad) apart, are farther from each other than a block is
  /// wide, no surface can be seen in it: such planar and edge points go to the coarser levels only.
  /// 0 = to all.
  LocalMap(double voxel_size, int levels, double planarity, double row_spacing = 0.0);

  /// Adds the large sets and the scattered points.
  void insert(const Features& features, const Pose& T_map_points);

  /// The correspondences of the points of these sets that find a surface within `max_distance` (m)
  /// on the finest level that has one, starting at `first_level` (0 = finest). `last`: what was
  /// found at another pose, or empty.
  std::vector<Correspondence> match(const Features& features, const Pose& T_map_points,
                                    double max_distance, double range_noise, int first_level,
                                    MatchedSurfaces& last);

  /// True when a point lies in the finest voxel of `point` (map frame).
  bool occupied(const Eigen::Vector3d& point) const;

  void remove_beyond(const Eigen::Vector3d& center, double radius);
  void clear();
  std::size_t size() const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    for (auto* maps : {&planes_, &lines_, &scattered_})
      for (SurfaceMap& map : *maps) archive(map);
  }

 private:
  std::vector<double> reach_;       // m, up to which the finer levels take planes and lines
  std::vector<SurfaceMap> planes_;  // finest first
  std::vector<SurfaceMap> lines_;
  std::vector<SurfaceMap> scattered_;
};

}  // namespace lego_loam_sc
