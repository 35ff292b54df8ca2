// SPDX-License-Identifier: BSD-3-Clause
#include "slam/map_cloud.hpp"

#include "mapping/voxel_table.hpp"

namespace lego_loam_sc {

std::vector<Eigen::Vector4f> make_map(std::span<const KeyFrame> key_frames,
                                      std::span<const Pose> T_map_key, double voxel_size) {
  struct Nothing {};
  VoxelTable<Nothing> taken;
  std::vector<Eigen::Vector4f> map;
  for (std::size_t k = 0; k < key_frames.size(); ++k) {
    const KeyFrame& key_frame = key_frames[k];
    for (const auto* cloud : {&key_frame.planars, &key_frame.edges, &key_frame.scattered, &key_frame.others}) {
      for (const PackedPoint& point : *cloud) {
        const Eigen::Vector3d p = T_map_key[k] * point.position().cast<double>();
        const auto key = key_of(p / voxel_size);
        if (!key || !taken.find_or_insert(*key).second) continue;
        map.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()),
                         static_cast<float>(p.z()), static_cast<float>(point.intensity));
      }
    }
  }
  return map;
}

}  // namespace lego_loam_sc
