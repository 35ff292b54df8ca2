// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lego_loam_sc {

/// One sweep of the LiDAR as read from a file or a driver. The optional arrays are empty or hold
/// one entry per point.
struct Scan {
  std::int64_t stamp_ns = 0;            ///< time of the scan's pose
  std::vector<Eigen::Vector3f> points;  ///< LiDAR frame, metres; NaN and zeros mean "no return"
  std::vector<float> intensity;         ///< optional, in the sensor's unit
  std::vector<std::uint16_t> ring;      ///< optional, in the sensor's numbering
  std::vector<std::int32_t> offset_ns;  ///< optional, time of the point minus `stamp_ns`

  /// Number of points.
  std::size_t size() const { return points.size(); }
};

/// Whether a point is a return: finite and not at the origin.
inline bool is_return(const Eigen::Vector3f& point) {
  return point.allFinite() && !point.isZero(0.0F);
}

}  // namespace lego_loam_sc
