// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/pose.hpp"
#include "registration/correspondence.hpp"

namespace lego_loam_sc {

/// Whether the times of the points fit the motion. A sweep that is de-skewed with s times its times
/// leaves residuals that are linear in s: least squares tell which s fits best. It is 1 when the
/// times are right, 0 when the scans are motion compensated already or the times mean nothing, -1
/// when they run backwards.
class SweepCheck {
 public:
  /// Takes the planes that a sweep was matched with. `scale`: of the robust kernel; `mean_twist`:
  /// of the motion since the previous scan; `twist`: that the points were de-skewed with, both in
  /// the sensor's own axes, m/s and rad/s.
  void add(std::span<const Correspondence> correspondences, const Pose& T_map_lidar, double scale,
           const Vector6& mean_twist, const Vector6& twist);

  /// False when the scans so far say that the times are wrong.
  bool fits() const;

  /// The factor of the times that fits best, and its standard error from how scans differ.
  /// @{
  double factor() const;
  double standard_error() const;
  /// @}
  /// Scans that took part.
  int scans() const { return scans_; }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(offered_, scans_, weights_, squared_weights_, sum_, squares_);
  }

 private:
  int offered_ = 0;
  int scans_ = 0;  // whose motion told
  double weights_ = 0.0;
  double squared_weights_ = 0.0;
  double sum_ = 0.0;      // of weighted factors
  double squares_ = 0.0;  // of weighted squares of factors
};

}  // namespace lego_loam_sc
