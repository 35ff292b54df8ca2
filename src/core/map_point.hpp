// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace lego_loam_sc {

/// A point of a map or another cloud, with the key frame that it comes from.
struct MapPoint {
  Eigen::Vector3f position;    ///< m, in the frame of the cloud
  float intensity = 0.0f;      ///< in the sensor's own unit
  std::int32_t key_frame = 0;  ///< index

  /// Bit by bit.
  bool operator==(const MapPoint&) const = default;
};

}  // namespace lego_loam_sc
