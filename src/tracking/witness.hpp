// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "map/range_view.hpp"

namespace lego_loam_sc {

/// What the points of a scan say about its pose, beside what the last key frames have seen.
struct Testimony {
  int agreeing = 0;       ///< lie where a key frame saw a surface
  int contradicting = 0;  ///< lie where each key frame that saw the place saw through it

  /// The share of contradicting points, NaN when too few of them say anything.
  double contradiction() const;
};

/// Checks every pose with points that did not serve to find it: a few hundred of a scan, taken by a
/// fixed rule from all its points. The match is judged by distances from surfaces; this judges by
/// the free space that the rays of the last key frames have crossed, so that nothing that moves
/// with the sensor and no choice of features deceives both.
class Witness {
 public:
  /// `row_spacing` of the sensor, rad.
  explicit Witness(double row_spacing) : row_spacing_(row_spacing) {}

  /// Looks at a scan: `points` are de-skewed, in its LiDAR frame, at `T_map_lidar`.
  Testimony hear(std::span<const Eigen::Vector3f> points, const Pose& T_map_lidar) const;

  /// Remembers what a key frame has seen.
  void add(int key_frame, std::span<const Eigen::Vector3f> points, const Pose& T_map_key);

  /// The key frames have moved with the pose graph.
  void correct(std::span<const Pose> T_map_key);

  /// Forgets all views.
  void clear() { views_.clear(); }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(views_);
  }

 private:
  struct PlacedView {
    int key_frame = 0;
    Pose T_map_key = Pose::Identity();
    RangeView view;

    template <class Archive>
    void state(Archive& archive) {
      archive(key_frame, T_map_key, view);
    }
  };

  double row_spacing_;
  std::vector<PlacedView> views_;  // oldest first
};

/// Every n-th of some points, about as many as a testimony needs.
std::vector<std::size_t> witnesses(std::size_t points);

}  // namespace lego_loam_sc
