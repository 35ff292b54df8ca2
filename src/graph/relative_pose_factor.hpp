// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtsam/geometry/Pose3.h>
#include <gtsam/nonlinear/NonlinearFactor.h>

#include "core/pose.hpp"

namespace lego_loam_sc {

/// || Log(expected^-1 T_a^-1 T_b) + offset ||, private to the pose graph. GTSAM's BetweenFactor
/// omits the derivative of the logarithm, which shifts the optimum for large residuals.
class RelativePoseFactor : public gtsam::NoiseModelFactor2<gtsam::Pose3, gtsam::Pose3> {
 public:
  RelativePoseFactor(int a, int b, const gtsam::Pose3& expected, const Vector6& offset,
                     const gtsam::SharedNoiseModel& noise)
      : NoiseModelFactor2(noise, a, b), inverse_expected_(expected.inverse()), offset_(offset) {}

  gtsam::Vector evaluateError(const gtsam::Pose3& T_a, const gtsam::Pose3& T_b,
                              boost::optional<gtsam::Matrix&> Ha,
                              boost::optional<gtsam::Matrix&> Hb) const override {
    const gtsam::Pose3 relative = T_a.between(T_b);
    Matrix6 derivative;
    const Vector6 residual =
        gtsam::Pose3::Logmap(inverse_expected_ * relative, derivative) + offset_;
    if (Ha) *Ha = -derivative * relative.inverse().AdjointMap();
    if (Hb) *Hb = derivative;
    return residual;
  }

 private:
  gtsam::Pose3 inverse_expected_;
  Vector6 offset_;
};

}  // namespace lego_loam_sc
