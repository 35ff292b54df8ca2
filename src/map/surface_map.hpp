// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "map/voxel_table.hpp"

namespace lego_loam_sc {

/// The plane or line fitted to the points of a block, or their mean.
struct Surface {
  /// What was fitted.
  enum class Kind : std::uint8_t { none, plane, line, point };

  Kind kind = Kind::none;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();       ///< map frame, m
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit normal, or direction of the line
  double variance = 0.0;  ///< m^2, normal to the plane, across the line, or mean of all axes
  double range = 0.0;     ///< m, mean horizontal range at which its points were measured
};

/// Of a map of surfaces.
struct SurfaceMapSettings {
  Surface::Kind kind = Surface::Kind::plane;  ///< planes or lines only; point: what fits best
  double voxel_size = 0.5;                    ///< m
  double planarity = 0.1;                     ///< maximum eigenvalue ratio, see surface_of
  /// m; of kind `point`: farther away a block holds a single row of the sensor, and the line or
  /// plane through it would be that of the beam, not of the object. 0 = no limit.
  double max_shape_range = 0.0;
};

/// The key of no block: the outermost cells of the grid are never used, see voxel_table.hpp.
constexpr VoxelKey kNoBlock = pack_cell(-kMaxCell, -kMaxCell, -kMaxCell);

/// An incremental voxel map of surfaces. Each voxel keeps the count, sum and sum of squares of all
/// its points, so a surface averages the noise of many scans. Surfaces are fitted to blocks of 2 x
/// 2 x 2 voxels. Blocks overlap: a point belongs to the block with the nearest centre, at least
/// half a voxel from its border, so no surface is split at a voxel border. A fit is kept until the
/// block has grown enough, which is checked less often the more points it has.
class SurfaceMap {
 public:
  /// An empty map.
  explicit SurfaceMap(const SurfaceMapSettings& settings);

  /// Inserts points (map frame, m) with the horizontal ranges (m) at which they were measured; 0
  /// when `ranges` is empty.
  void insert(std::span<const Eigen::Vector3d> points, std::span<const double> ranges = {});

  /// The block of `point`; kNoBlock outside the grid.
  VoxelKey block_of(const Eigen::Vector3d& point) const;

  /// The surface of a block; kind `none` where no surface fits (for kind `point`: where points are
  /// few). A plane has variances l1 <= l2 <= l3 along its axes with
  /// l1 <= planarity * l2, a line l2 <= planarity * l3.
  Surface surface_of(VoxelKey block);

  /// The table exceeds the CPU caches: before many surfaces are read, prefetch their table slots,
  /// then their blocks.
  void prefetch(VoxelKey block) const { blocks_.prefetch(block); }
  /// See prefetch.
  void prefetch_value(VoxelKey block) const { blocks_.prefetch_value(block); }

  /// Whether the voxel of `point` holds points.
  bool occupied(const Eigen::Vector3d& point) const;

  /// Removes voxels farther than `radius` (m) from `center`.
  void remove_beyond(const Eigen::Vector3d& center, double radius);

  /// Removes everything.
  void clear();
  /// Number of voxels.
  std::size_t size() const { return voxels_.size(); }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(voxels_, blocks_, revision_);
  }

 private:
  // Coordinates are relative to the centre of the voxel or block, so that float suffices.
  struct Voxel {
    std::uint32_t count = 0;
    float range = 0.0f;                             // sum, m
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();  // of the points
    std::array<float, 6> square{};                  // sums of xx yy zz xy xz yz

    template <class Archive>
    void state(Archive& archive) {
      archive(count, range, sum, square);
    }
  };
  struct Block {
    std::uint32_t due = 0;    // revision of the map at which the fit is checked next
    std::uint32_t count = 0;  // points at the last fit
    Surface::Kind kind = Surface::Kind::none;
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    Eigen::Vector3f direction = Eigen::Vector3f::Zero();
    float variance = 0.0f;
    float range = 0.0f;

    template <class Archive>
    void state(Archive& archive) {
      archive(due, count, kind, mean, direction, variance, range);
    }
  };

  void add(const Eigen::Vector3d& point, double range, const Cell& cell);
  Eigen::Vector3d corner_of(const Cell& cell, double cells) const;
  // `variance`: eigenvalues of the covariance of a block's points, ascending, m^2.
  Surface::Kind kind_of(const Eigen::Vector3d& variance, std::uint32_t count, double range) const;
  void refit_if_grown(Block& block, const Cell& corner);
  void fit(const std::array<const Voxel*, 8>& voxels, std::uint32_t count, Block& block) const;

  SurfaceMapSettings settings_;
  VoxelTable<Voxel> voxels_;
  VoxelTable<Block> blocks_;
  std::uint32_t revision_ = 1;
};

}  // namespace lego_loam_sc
