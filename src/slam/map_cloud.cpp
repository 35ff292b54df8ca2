// SPDX-License-Identifier: BSD-3-Clause
#include "slam/map_cloud.hpp"

#include "mapping/voxel_table.hpp"

namespace lego_loam_sc {

std::vector<MapPoint> make_map(std::span<const KeyFrame> key_frames,
                               std::span<const Pose> T_map_key, double voxel_size) {
  struct Nothing {};
  VoxelTable<Nothing> taken;
  std::vector<MapPoint> map;
  for (std::size_t k = 0; k < key_frames.size(); ++k) {
    const KeyFrame& key_frame = key_frames[k];
    for (const auto* cloud :
         {&key_frame.planars, &key_frame.edges, &key_frame.scattered, &key_frame.others}) {
      for (const PackedPoint& point : *cloud) {
        const Eigen::Vector3d p = T_map_key[k] * point.position().cast<double>();
        const auto key = key_of(p / voxel_size);
        if (!key || !taken.find_or_insert(*key).second) continue;
        map.push_back({p.cast<float>(), static_cast<float>(point.intensity), static_cast<int>(k)});
      }
    }
  }
  return map;
}

std::vector<MapPoint> points_of(const KeyFrame& key_frame, int number) {
  std::vector<MapPoint> points;
  for (const auto* cloud : {&key_frame.planars, &key_frame.edges, &key_frame.others})
    for (const PackedPoint& point : *cloud)
      points.push_back({point.position(), static_cast<float>(point.intensity), number});
  return points;
}

}  // namespace lego_loam_sc
