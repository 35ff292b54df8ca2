// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"
#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"

namespace lego_loam_sc {

/// Finds the returns that move with the sensor: those of the vehicle and of what is mounted on it.
/// A pixel that keeps its range while the sensor moves sees either the body or a surface along
/// which it moves, a road or the wall of a tunnel. The normal of the surface tells them apart:
/// where the motion has a part along it a fixed surface would have changed its range. The motion is
/// taken from the pixels that did change (range flow, Spies, Jaehne and Barron 2002), so that a
/// body that fills most of the image cannot hide it, as it does from registration.
class BodyMask {
 public:
  /// Knows no body yet.
  explicit BodyMask(const SensorModel& sensor);

  /// Compares a scan with an earlier one. `image` has all returns, the masked ones as well.
  void observe(const RangeImage& image);

  /// Marks the points of the body in `remove` (one entry per point); returns their number. A point
  /// in front of the body or behind it is none.
  std::size_t mark(const RangeImage& image, std::vector<std::uint8_t>& remove) const;

  /// Number of pixels that see the body.
  std::size_t size() const { return size_; }
  /// m; nearly all of the body is within it.
  double range() const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(reference_, body_, votes_, size_, age_, compared_, paused_);
  }

 private:
  // What a pixel says of the motion m = (v, w) since the reference: row.m = change but for sigma.
  struct Flow {
    Vector6 row;
    double change = 0.0;  // m, along the normal
    double sigma = 0.0;   // m, of `change` from noise
  };
  enum class Kind { neutral, world, body, other };

  Eigen::Vector3d direction(std::size_t pixel) const;
  bool flow_at(int row, int column, const std::vector<float>& range, Flow& flow) const;
  // The motion since the reference, m and rad.
  struct Motion {
    Vector6 mean = Vector6::Zero();
    Matrix6 covariance = Matrix6::Zero();
  };
  static bool has_changed(const Flow& flow);
  static Kind kind_of(const Flow& flow, const Motion& motion);
  static bool find_motion(const std::vector<Flow>& flows, Motion& motion);
  void look_for_body(const std::vector<Flow>& flows, const std::vector<float>& range);
  void vote(const std::vector<float>& range, const Motion& motion, int weight);
  bool is_masked(std::size_t pixel) const;
  void forget_changed(const std::vector<float>& range);
  float tolerance_at(int row, int column, float range) const;

  int rows_;
  int columns_;
  float noise_;                     // m, one sigma
  std::vector<double> elevation_;   // rad, by row
  std::vector<double> azimuth_;     // rad, by column
  std::vector<float> reference_;    // m, range of each pixel in an earlier scan; 0 = none
  std::vector<float> body_;         // m, range of the body in each pixel
  std::vector<std::int8_t> votes_;  // for the body, of each pixel
  std::size_t size_ = 0;
  int age_ = 0;       // scans since the reference
  int compared_ = 0;  // scans in motion
  int paused_ = 0;    // scans not looked at since the last comparison
};

}  // namespace lego_loam_sc
