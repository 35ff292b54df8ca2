// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "core/pose.hpp"
#include "features/features.hpp"
#include "map/local_map.hpp"
#include "mapping/settings.hpp"
#include "mapping/sweep_check.hpp"
#include "mapping/sweep_priors.hpp"
#include "registration/localizability.hpp"

namespace lego_loam_sc {

/// Outcome of matching one scan against the local map.
struct MapMatch {
  Pose T_map_lidar = Pose::Identity();  ///< at the scan's reference time
  Vector6 twist = Vector6::Zero();  ///< of the sensor at that time, m/s and rad/s in its own frame
  bool matched = false;             ///< false: the pose is the guess
  int points = 0;                   ///< after the voxel filter
  int matches = 0;                  ///< points with a correspondence
  int inliers = 0;                  ///< correspondences with a residual below 3 sigmas
  int iterations = 0;
  double rmse = 0.0;  ///< m, of the residuals from planes and lines, with their robust weights
  /// Of the perturbation of core/pose.hpp; the prior's when not matched.
  Matrix6 covariance = Matrix6::Zero();
  Localizability localizability;
};

/// The initial guess of a scan's pose.
struct ScanGuess {
  Pose T_map_lidar = Pose::Identity();         ///< at the scan's reference time, from odometry
  Pose T_map_predicted = Pose::Identity();     ///< the same at constant velocity
  Pose T_previous_current = Pose::Identity();  ///< motion since the previous scan
  double seconds = 0.1;                        ///< of that motion
  bool measured = true;  ///< by odometry; false: T_map_lidar is the prediction
};

/// Scan-to-map refinement, paper 2.3 (4).
class Mapper {
 public:
  /// `range_noise` in m, one sigma; `row_spacing` in rad, see LocalMap.
  Mapper(const MappingSettings& settings, double range_noise, double row_spacing = 0.0);

  /// Matches the large feature sets with the map. The velocity during the sweep is estimated with
  /// the pose; its prior is the motion since the previous scan.
  MapMatch refine(const Features& features, const ScanGuess& guess);

  /// The same when the motion since the previous scan at `T_map_previous` is unknown, as at the
  /// start of a drive: refines several poses within reach of it besides the guess, and returns the
  /// match in which most of the scan agrees with the map.
  MapMatch search(const Features& features, const ScanGuess& guess, const Pose& T_map_previous);

  /// Whether the times of the points fit the motion.
  const SweepCheck& sweep_check() const { return sweep_check_; }

  /// Adds features that are already de-skewed.
  void insert(const Features& deskewed, const Pose& T_map_lidar);

  /// Adds the present scan, unless the sensor has hardly moved since the last insertion: a
  /// standing sensor would add only its beam pattern. Removes what lies beyond the map's radius.
  void add_scan(const Features& deskewed, const Pose& T_map_lidar);

  /// Forgets the map.
  void clear();
  /// Whether the map holds nothing.
  bool empty() const { return map_.size() == 0; }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(map_, sweep_check_, spacing_, last_insertion_, last_eviction_);
  }

 private:
  // A scan while it is being registered.
  struct Registration {
    Pose pose;      // T_map_lidar
    Vector6 twist;  // that the points are de-skewed with
    MapCorrespondences correspondences;
    std::array<double, 3> scales{};  // of the kernel of each set
    int iterations = 0;
  };

  Features points_to_match(const Features& features);
  bool converge(const Features& points, const PosePrior& prior, const VelocityPrior& velocity_prior,
                Registration& registration);
  Localizability analyse(const Features& points, const Registration& registration, double seconds);
  MapMatch align(const Features& points, const ScanGuess& guess);
  void adapt_spacing(int points);

  MappingSettings settings_;
  double range_noise_;
  LocalMap map_;
  SweepCheck sweep_check_;
  double spacing_;  // m, voxel size of the filter over the matched points
  std::optional<Eigen::Vector3d> last_insertion_;
  Eigen::Vector3d last_eviction_ = Eigen::Vector3d::Zero();
};

}  // namespace lego_loam_sc
