// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace lego_loam_sc {

/// What one scan has seen in each direction: how far it is free, and where its surfaces are. Coarse
/// and small; it answers for the free space that a map of surfaces does not know.
class RangeView {
 public:
  /// What the view says about a place.
  enum class Sight {
    unknown,  ///< nothing was seen in that direction, or what was seen hides it
    surface,  ///< a surface was seen there
    free,     ///< it was seen through
  };

  /// `points`: de-skewed, in the frame of the view, m. `row_spacing` (rad) of the sensor:
  /// directions are told apart no finer.
  RangeView(std::span<const Eigen::Vector3f> points, double row_spacing);

  /// `point` in the frame of the view.
  Sight sight(const Eigen::Vector3f& point) const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(bin_, lowest_, rows_, nearest_, farthest_);
  }
  RangeView() = default;

 private:
  int row_of(const Eigen::Vector3f& point) const;

  float bin_ = 0.0f;     // rad, of elevation
  float lowest_ = 0.0f;  // rad, lower end of row 0
  int rows_ = 0;
  std::vector<float> nearest_, farthest_;  // m, of the points in each direction; row by row
};

}  // namespace lego_loam_sc
