// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace lego_loam_sc {

/// A point that a key frame gave to a map or to another cloud.
struct MapPoint {
  Eigen::Vector3f position;    ///< m; the cloud says in which frame
  float intensity = 0.0f;      ///< in the sensor's own unit
  std::int32_t key_frame = 0;  ///< its number

  /// The same in all members.
  bool operator==(const MapPoint&) const = default;
};

}  // namespace lego_loam_sc
