// SPDX-License-Identifier: BSD-3-Clause
#include "key_frames/map_cloud.hpp"

#include <array>
#include <cstdint>

#include "map/voxel_table.hpp"

namespace lego_loam_sc {
namespace {

// Which voxels are taken. Those of a surface lie side by side: a bit for each voxel of a cube of
// 8 x 8 x 8 takes a fifteenth of the memory of a table of voxels.
class TakenVoxels {
 public:
  explicit TakenVoxels(double size) : size_(size) {}

  // True for the first point of its voxel.
  bool take(const Eigen::Vector3d& point) {
    const auto cell = cell_of(point / size_);
    if (!cell) return false;
    const auto [x, y, z] = *cell;
    auto& layers = cubes_.find_or_insert(pack_cell(x >> 3, y >> 3, z >> 3)).first;
    std::uint64_t& layer = layers[z & 7];
    const std::uint64_t bit = std::uint64_t{1} << ((y & 7) << 3 | (x & 7));
    const bool first = !(layer & bit);
    layer |= bit;
    return first;
  }

 private:
  double size_;
  VoxelTable<std::array<std::uint64_t, 8>> cubes_;
};

}  // namespace

void make_map(const KeyFrames& key_frames, std::span<const Pose> T_map_key, double voxel_size,
              const std::function<void(std::span<const MapPoint>)>& take) {
  TakenVoxels voxels(voxel_size);
  std::vector<MapPoint> points;
  for (std::size_t k = 0; k < key_frames.size(); ++k) {
    points.clear();
    for (MapPoint point : points_of(key_frames[k], static_cast<std::int32_t>(k))) {
      const Eigen::Vector3d p = T_map_key[k] * point.position.cast<double>();
      if (!voxels.take(p)) continue;
      point.position = p.cast<float>();
      points.push_back(point);
    }
    take(points);
  }
}

std::vector<MapPoint> make_map(const KeyFrames& key_frames, std::span<const Pose> T_map_key,
                               double voxel_size) {
  std::vector<MapPoint> map;
  make_map(key_frames, T_map_key, voxel_size, [&](std::span<const MapPoint> points) {
    map.insert(map.end(), points.begin(), points.end());
  });
  return map;
}

std::vector<MapPoint> points_of(const KeyFrame& key_frame, std::int32_t number) {
  std::vector<MapPoint> points;
  for (const auto* cloud :
       {&key_frame.planars, &key_frame.edges, &key_frame.scattered, &key_frame.others})
    for (const PackedPoint& point : *cloud)
      points.push_back({point.position(), static_cast<float>(point.intensity), number});
  return points;
}

}  // namespace lego_loam_sc
