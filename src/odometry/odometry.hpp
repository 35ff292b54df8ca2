// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "core/pose.hpp"
#include "features/features.hpp"
#include "odometry/feature_index.hpp"
#include "odometry/settings.hpp"
#include "registration/localizability.hpp"

namespace lego_loam_sc {

/// Motion from the previous scan to the current one, between their reference times.
struct Motion {
  Pose T_previous_current = Pose::Identity();
  bool solved = false;  ///< false: the scans do not match, the pose is the guess
  int edges = 0;        ///< correspondences of the last association
  int planars = 0;
  int iterations = 0;  ///< Levenberg-Marquardt steps of all solves
  Localizability localizability;
};

/// Scan-to-scan odometry, paper 2.3 (3): features of the current scan, F_e and F_p, against the
/// large feature sets of the previous one, edges with edges and ground with ground (label
/// matching), in two Levenberg-Marquardt steps: [t_z, roll, pitch] from planes, then [t_x, t_y,
/// yaw] from edges. When F_p holds more than ground, its planes constrain the other unknowns too,
/// and one joint solve replaces the two steps.
class Odometry {
 public:
  /// `range_noise` in m, one sigma.
  Odometry(const OdometrySettings& settings, double range_noise);

  /// `guess` is the predicted motion, `seconds` the time since the previous scan. Points with times
  /// are de-skewed with the estimated motion in every iteration.
  Motion estimate(const Features& features, const Pose& guess, double seconds) const;

  /// Makes `deskewed` the target of the next scan.
  void set_previous(const Features& deskewed);

  /// Whether there is a scan to match with.
  bool has_previous() const { return previous_.has_value(); }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    bool has = has_previous();
    Features previous;
    if (has) {
      previous.edges_large = previous_->edges.points();
      previous.planars_large = previous_->planars;
    }
    archive(has, previous.edges_large, previous.planars_large);
    if (Archive::kReads && has) set_previous(previous);
  }

 private:
  // The large sets of the previous scan, de-skewed.
  struct Previous {
    FeatureIndex edges;
    FeatureIndex ground;                // planar points on the ground
    std::vector<FeaturePoint> planars;  // all planar points
  };

  OdometrySettings settings_;
  double range_noise_;
  std::optional<Previous> previous_;
};

}  // namespace lego_loam_sc
