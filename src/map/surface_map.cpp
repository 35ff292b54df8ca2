// SPDX-License-Identifier: BSD-3-Clause
#include "map/surface_map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lego_loam_sc {
namespace {

// Fewer points do not determine a surface.
constexpr std::uint32_t kMinPoints = 6;
// Minimum standard deviation along a surface, in voxels; with less its orientation is arbitrary.
constexpr double kMinExtent = 0.15;
// Maximum standard deviation of a fitted direction from the noise of its points, rad: a quarter of
// the angle at which a surface starts to count as a constraint along itself (localizability.cpp).
constexpr double kMaxDirectionSigma = 0.05;
// A surface is fitted again when the number of its points has grown by this share.
constexpr double kGrowth = 0.1;
// Insertions between two checks of a block: one more for every so many points, up to a maximum.
constexpr std::uint32_t kPointsPerRevision = 16;
constexpr std::uint32_t kMaxRevisions = 10;

}  // namespace

SurfaceMap::SurfaceMap(const SurfaceMapSettings& settings) : settings_(settings) {}

// The lowest corner of a cell, shifted by `cells` along each axis, m.
Eigen::Vector3d SurfaceMap::corner_of(const Cell& cell, double cells) const {
  const Eigen::Vector3d corner(static_cast<double>(cell[0]), static_cast<double>(cell[1]),
                               static_cast<double>(cell[2]));
  return (corner.array() + cells).matrix() * settings_.voxel_size;
}

void SurfaceMap::insert(std::span<const Eigen::Vector3d> points, std::span<const double> ranges) {
  // The table exceeds the CPU caches: each voxel is prefetched some points ahead, in two steps.
  constexpr std::size_t kAhead = 16;
  std::array<std::optional<Cell>, kAhead> ahead;
  for (std::size_t next = 0; next < points.size() + kAhead; ++next) {
    std::optional<Cell>& cell = ahead[next % kAhead];
    if (next >= kAhead && cell) {
      const std::size_t i = next - kAhead;
      add(points[i], ranges.empty() ? 0.0 : ranges[i], *cell);
    }
    cell.reset();
    if (next < points.size()) cell = cell_of(points[next] / settings_.voxel_size);
    if (cell) voxels_.prefetch(pack_cell(*cell));
    const std::optional<Cell>& half_way = ahead[(next + kAhead / 2) % kAhead];
    if (half_way) voxels_.prefetch_value(pack_cell(*half_way));
  }
  ++revision_;
}

void SurfaceMap::add(const Eigen::Vector3d& point, double range, const Cell& cell) {
  Voxel& voxel = voxels_.find_or_insert(pack_cell(cell)).first;
  const Eigen::Vector3f d = (point - corner_of(cell, 0.5)).cast<float>();
  ++voxel.count;
  voxel.range += static_cast<float>(range);
  voxel.sum += d;
  voxel.square[0] += d.x() * d.x();
  voxel.square[1] += d.y() * d.y();
  voxel.square[2] += d.z() * d.z();
  voxel.square[3] += d.x() * d.y();
  voxel.square[4] += d.x() * d.z();
  voxel.square[5] += d.y() * d.z();
}

VoxelKey SurfaceMap::block_of(const Eigen::Vector3d& point) const {
  return key_of((point / settings_.voxel_size).array() - 0.5).value_or(kNoBlock);
}

Surface SurfaceMap::surface_of(VoxelKey block) {
  if (block == kNoBlock) return {};
  const Cell corner = unpack_cell(block);
  Block& kept = blocks_.find_or_insert(block).first;
  if (revision_ >= kept.due) refit_if_grown(kept, corner);
  Surface surface;
  surface.kind = kept.kind;
  surface.mean = corner_of(corner, 1.0) + kept.mean.cast<double>();
  surface.direction = kept.direction.cast<double>();
  surface.variance = kept.variance;
  surface.range = kept.range;
  return surface;
}

// Fits the surface again when the block has grown enough, and schedules the next check.
void SurfaceMap::refit_if_grown(Block& block, const Cell& corner) {
  std::array<const Voxel*, 8> voxels{};
  std::uint32_t count = 0;
  for (int i = 0; i < 8; ++i) {
    const auto& [x, y, z] = corner;
    voxels[i] = voxels_.find(pack_cell(x + (i & 1), y + ((i >> 1) & 1), z + ((i >> 2) & 1)));
    if (voxels[i]) count += voxels[i]->count;
  }
  if (count >= kMinPoints && count > (1.0 + kGrowth) * block.count) fit(voxels, count, block);
  block.due = revision_ + 1 + std::min(block.count / kPointsPerRevision, kMaxRevisions);
}

Surface::Kind SurfaceMap::kind_of(const Eigen::Vector3d& variance, std::uint32_t count) const {
  const double min_variance = std::pow(kMinExtent * settings_.voxel_size, 2);
  const double ratio =
      std::min(settings_.planarity, kMaxDirectionSigma * kMaxDirectionSigma * count);
  const bool plane = variance[1] >= min_variance && variance[0] <= ratio * variance[1];
  const bool line = variance[2] >= min_variance && variance[1] <= ratio * variance[2];
  switch (settings_.kind) {
    case Surface::Kind::plane: return plane ? Surface::Kind::plane : Surface::Kind::none;
    case Surface::Kind::line: return line ? Surface::Kind::line : Surface::Kind::none;
    default: return Surface::Kind::point;
  }
}

void SurfaceMap::fit(const std::array<const Voxel*, 8>& voxels, std::uint32_t count,
                     Block& block) const {
  // Sums over all voxels, relative to the centre of the block.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  double range = 0.0;
  for (int i = 0; i < 8; ++i) {
    if (!voxels[i]) continue;
    const Voxel& v = *voxels[i];
    const Eigen::Vector3d own_sum = v.sum.cast<double>();
    const Eigen::Vector3d o =
        settings_.voxel_size *
        Eigen::Vector3d((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5);
    const auto& s = v.square;
    Eigen::Matrix3d own;
    own << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    square += own + own_sum * o.transpose() + o * own_sum.transpose() + v.count * o * o.transpose();
    sum += own_sum + v.count * o;
    range += v.range;
  }
  const Eigen::Vector3d mean = sum / count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(square / count - mean * mean.transpose());
  const Eigen::Vector3d variance = eigen.eigenvalues().cwiseMax(0.0);

  block.count = count;
  block.mean = mean.cast<float>();
  block.range = static_cast<float>(range / count);
  block.kind = kind_of(variance, count);
  switch (block.kind) {
    case Surface::Kind::plane:
      block.direction = eigen.eigenvectors().col(0).cast<float>();
      block.variance = static_cast<float>(variance[0]);
      break;
    case Surface::Kind::line:
      block.direction = eigen.eigenvectors().col(2).cast<float>();
      block.variance = static_cast<float>(variance[1]);
      break;
    case Surface::Kind::point: block.variance = static_cast<float>(variance.mean()); break;
    case Surface::Kind::none: break;
  }
}

bool SurfaceMap::occupied(const Eigen::Vector3d& point) const {
  const auto key = key_of(point / settings_.voxel_size);
  return key && voxels_.find(*key);
}

void SurfaceMap::remove_beyond(const Eigen::Vector3d& center, double radius) {
  const auto within = [&](VoxelKey key) {
    return (corner_of(unpack_cell(key), 0.5) - center).squaredNorm() <= radius * radius;
  };
  voxels_.retain(within);
  blocks_.retain(within);
  ++revision_;
}

void SurfaceMap::clear() {
  voxels_.clear();
  blocks_.clear();
  ++revision_;
}

}  // namespace lego_loam_sc
