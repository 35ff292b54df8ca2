// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace lego_loam_sc {

struct Features;

/// A point of a key frame in 8 bytes: 5 mm steps up to 163 m, intensity as half a float.
struct PackedPoint {
  static constexpr float kStep = 0.005f;  ///< m

  std::int16_t x, y, z;
  Eigen::half intensity;

  /// LiDAR frame of the key frame, m.
  Eigen::Vector3f position() const {
    return kStep *
           Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
  }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(x, y, z, intensity.x);
  }
};

/// Rounds to the nearest step; points out of reach are clamped to it.
PackedPoint pack(const Eigen::Vector3f& position, float intensity);

/// What is kept of a key frame: its points in its own LiDAR frame at its reference time,
/// de-skewed and thinned out.
struct KeyFrame {
  std::int64_t reference_ns = 0;
  double travelled = 0.0;              ///< m along the path since the start
  std::vector<PackedPoint> planars;    ///< of the large planar set
  std::vector<PackedPoint> edges;      ///< of the large edge set
  std::vector<PackedPoint> scattered;  ///< of the scattered points
  std::vector<PackedPoint> others;     ///< further points of ground and clusters, for the map

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(reference_ns, travelled, planars, edges, scattered, others);
  }
};

/// The large sets and the scattered points as features again, for matching.
Features unpack(const KeyFrame& key_frame);

}  // namespace lego_loam_sc
