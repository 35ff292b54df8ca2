// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "map/voxel_table.hpp"

namespace lego_loam_sc {

/// The plane or line that the points round a place lie on, or their middle.
struct Surface {
  enum class Kind : std::uint8_t { none, plane, line, point };

  Kind kind = Kind::none;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();       ///< map frame, m
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit normal, or direction of the line
  double variance = 0.0;  ///< m^2, of the points across the surface, or in each direction
  double range = 0.0;     ///< m, mean horizontal range from which its points were seen
};

struct SurfaceMapSettings {
  Surface::Kind kind = Surface::Kind::plane;  ///< what is fitted
  double voxel_size = 0.5;                    ///< m
  double planarity = 0.1;                     ///< largest ratio of the eigenvalues, see surface_of
};

/// No block of any map: the outermost cells of the grid stay free, see voxel_table.hpp.
constexpr VoxelKey kNoBlock = pack_cell(-kMaxCell, -kMaxCell, -kMaxCell);

/// An incremental voxel map of surfaces. Each voxel keeps the count, sum and sum of squares of all
/// points that ever fell into it, so that a surface averages the noise of many scans. A surface is
/// fitted to a block of 2 x 2 x 2 voxels. Blocks overlap: each place belongs to the one whose
/// middle is nearest, hence lies at least half a voxel from its border, and no surface is cut in
/// two at the border of a voxel. Fits are kept until enough points have come; the more a block has,
/// the less often that is looked at.
class SurfaceMap {
 public:
  explicit SurfaceMap(const SurfaceMapSettings& settings);

  /// Adds points, map frame, m, and the horizontal ranges (m) from which they were seen; without
  /// ranges these are 0.
  void insert(std::span<const Eigen::Vector3d> points, std::span<const double> ranges = {});

  /// The block that `point` belongs to; kNoBlock when it is out of the map's range.
  VoxelKey block_of(const Eigen::Vector3d& point) const;

  /// The surface of a block; kind `none` where there is no clear one (of a map of `point`s: where
  /// there are few points). A plane has variances l1 <= l2 <= l3 along its axes with
  /// l1 <= planarity * l2, a line l2 <= planarity * l3.
  Surface surface_of(VoxelKey block);

  /// The table is larger than the caches. Who will ask for many surfaces first fetches the places
  /// of their blocks, then the blocks.
  void prefetch(VoxelKey block) const { blocks_.prefetch(block); }
  void prefetch_value(VoxelKey block) const { blocks_.prefetch_value(block); }

  /// True when the voxel of `point` holds points.
  bool occupied(const Eigen::Vector3d& point) const;

  /// Forgets voxels farther than `radius` (m) from `center`.
  void remove_beyond(const Eigen::Vector3d& center, double radius);

  void clear();
  std::size_t size() const { return voxels_.size(); }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(voxels_, blocks_, revision_);
  }

 private:
  // Numbers are relative to the middle of the voxel or block, so that floats serve.
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
    std::uint32_t due = 0;    // revision of the map at which the block is looked at again
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
  // `variance`: along the axes of a block's points, ascending, m^2.
  Surface::Kind kind_of(const Eigen::Vector3d& variance, std::uint32_t count) const;
  void look_again(Block& block, const Cell& corner);
  void fit(const std::array<const Voxel*, 8>& voxels, std::uint32_t count, Block& block) const;

  SurfaceMapSettings settings_;
  VoxelTable<Voxel> voxels_;
  VoxelTable<Block> blocks_;
  std::uint32_t revision_ = 1;
};

}  // namespace lego_loam_sc
