// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surface_map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace lego_loam_sc {
namespace {

// Fewer points say nothing about a surface.
constexpr std::uint32_t kMinPoints = 6;
// Standard deviation along a surface, in voxels, below which its orientation is a guess.
constexpr double kMinSpread = 0.15;
// A kept fit is good until its points have grown by this share.
constexpr double kGrowth = 0.1;

}  // namespace

SurfaceMap::SurfaceMap(const SurfaceMapSettings& settings) : settings_(settings) {}

void SurfaceMap::insert(std::span<const Eigen::Vector3d> points) {
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d scaled = point / settings_.voxel_size;
    const auto key = key_of(scaled);
    if (!key) continue;
    const auto [voxel, is_new] = voxels_.find_or_insert(*key);
    if (is_new)
      voxel.origin = (scaled.array().floor() + 0.5).matrix() * settings_.voxel_size;
    const Eigen::Vector3d d = point - voxel.origin;
    voxel.sum += d;
    voxel.square.head<3>() += d.cwiseAbs2();
    voxel.square[3] += d.x() * d.y();
    voxel.square[4] += d.x() * d.z();
    voxel.square[5] += d.y() * d.z();
    ++voxel.count;
  }
  ++revision_;
}

const Surface& SurfaceMap::surface_at(const Eigen::Vector3d& point) {
  const Eigen::Vector3d corner = ((point / settings_.voxel_size).array() - 0.5).floor();
  const auto key = key_of(corner);
  if (!key) return nothing_;
  const auto [block, is_new] = blocks_.find_or_insert(*key);
  if (block.revision == revision_) return block.surface;
  block.revision = revision_;
  if (is_new) block.middle = (corner.array() + 1.0).matrix() * settings_.voxel_size;

  std::array<const Voxel*, 8> voxels{};
  std::uint32_t count = 0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d cell = corner + Eigen::Vector3d(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    if (const auto voxel_key = key_of(cell)) voxels[i] = voxels_.find(*voxel_key);
    if (voxels[i]) count += voxels[i]->count;
  }
  if (count >= kMinPoints && count > (1.0 + kGrowth) * block.count) {
    block.surface = fit(voxels, count, block.middle);
    block.count = count;
  }
  return block.surface;
}

Surface SurfaceMap::fit(const std::array<const Voxel*, 8>& voxels, std::uint32_t count,
                        const Eigen::Vector3d& middle) const {
  // Sums of all voxels, moved to the middle of the block.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (const Voxel* v : voxels) {
    if (!v) continue;
    const Eigen::Vector3d o = v->origin - middle;
    const auto& s = v->square;
    Eigen::Matrix3d own;
    own << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    square += own + v->sum * o.transpose() + o * v->sum.transpose() + v->count * o * o.transpose();
    sum += v->sum + v->count * o;
  }
  const Eigen::Vector3d mean = sum / count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(square / count - mean * mean.transpose());
  const Eigen::Vector3d variance = eigen.eigenvalues().cwiseMax(0.0);

  Surface surface;
  surface.mean = middle + mean;
  const double spread = kMinSpread * settings_.voxel_size;
  if (settings_.kind == Surface::Kind::plane) {
    if (variance[1] < spread * spread || variance[0] > settings_.planarity * variance[1])
      return surface;
    surface.direction = eigen.eigenvectors().col(0);
    surface.variance = variance[0];
  } else {
    if (variance[2] < spread * spread || variance[1] > settings_.planarity * variance[2])
      return surface;
    surface.direction = eigen.eigenvectors().col(2);
    surface.variance = variance[1];
  }
  surface.kind = settings_.kind;
  return surface;
}

bool SurfaceMap::occupied(const Eigen::Vector3d& point) {
  const auto key = key_of(point / settings_.voxel_size);
  return key && voxels_.find(*key);
}

void SurfaceMap::remove_beyond(const Eigen::Vector3d& center, double radius) {
  const double squared = radius * radius;
  voxels_.retain([&](const Voxel& v) { return (v.origin - center).squaredNorm() <= squared; });
  blocks_.retain([&](const Block& b) { return (b.middle - center).squaredNorm() <= squared; });
  ++revision_;
}

void SurfaceMap::clear() {
  voxels_.clear();
  blocks_.clear();
  ++revision_;
}

}  // namespace lego_loam_sc
