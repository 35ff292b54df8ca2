// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"

namespace lego_loam_sc {

/// A scan ordered by beam. All valid points are kept, one array per attribute: row by row from the
/// lowest beam, each row by ascending azimuth. `pixels` is the image, as indices into these arrays.
/// Paper 2.3 (1): row, column and range of every point.
struct RangeImage {
  int rows = 0;
  int columns = 0;

  std::vector<std::uint32_t> row_begin;  ///< rows + 1; row r is [row_begin[r], row_begin[r + 1])
  std::vector<Eigen::Vector3f> points;   ///< m, LiDAR frame levelled by the mounting angles, at
                                         ///< the time of each point
  std::vector<float> range;              ///< m
  std::vector<float> intensity;          ///< zeros when the sensor has none
  std::vector<float> time;               ///< s after the reference time; all zero when the scan
                                         ///< is motion compensated or has no times
  std::vector<std::uint16_t> column;     ///< 0 = straight back, ascending counter-clockwise

  std::vector<std::int32_t> pixels;  ///< rows x columns, index of the nearest point or -1

  int column_step = 1;  ///< median columns from a point of a row to the next; more than one when
                        ///< the sensor turns faster than its model says or fires less often

  std::int64_t stamp_ns = 0;      ///< of the scan
  std::int64_t reference_ns = 0;  ///< middle of the sweep, to which points are de-skewed: there
                                  ///< a velocity error has no effect on the pose

  /// Number of points.
  std::size_t size() const { return points.size(); }
  /// Index of the nearest point in a pixel, or -1.
  std::int32_t pixel(int row, int column_index) const {
    return pixels[static_cast<std::size_t>(row) * columns + column_index];
  }
};

/// Projects a scan. Points that are not finite, closer than min_range, beyond max_range or on no
/// row are dropped. The nearest of several points in one pixel represents it.
RangeImage project(const Scan& scan, const SensorModel& sensor);

/// Makes `pixels` anew from the points.
void fill_pixels(RangeImage& image);

}  // namespace lego_loam_sc
