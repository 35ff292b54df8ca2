// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lego_loam_sc {

/// One sweep of the LiDAR as it came from a file or a driver. The optional arrays are empty or
/// hold one entry for each point.
struct Scan {
  std::int64_t stamp_ns = 0;            ///< time of the scan's pose
  std::vector<Eigen::Vector3f> points;  ///< LiDAR frame, metres; NaN and zeros mean "no return"
  std::vector<float> intensity;         ///< in the sensor's own unit
  std::vector<std::uint16_t> ring;      ///< in the sensor's own numbering
  std::vector<std::int32_t> offset_ns;  ///< time of the point after `stamp_ns`, may be negative

  /// Number of points.
  std::size_t size() const { return points.size(); }
};

/// Whether the sensor got a return for a point.
inline bool is_return(const Eigen::Vector3f& point) {
  return point.allFinite() && !point.isZero(0.0F);
}

}  // namespace lego_loam_sc
