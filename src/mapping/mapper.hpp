// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/pose.hpp"
#include "features/features.hpp"
#include "map/local_map.hpp"
#include "mapping/elevation_bias.hpp"
#include "mapping/row_bias.hpp"
#include "mapping/sweep_check.hpp"
#include "mapping/settings.hpp"
#include "registration/localizability.hpp"

namespace lego_loam_sc {

/// Outcome of matching one scan against the local map.
struct MapMatch {
  Pose T_map_lidar = Pose::Identity();  ///< at the scan's reference time
  Vector6 twist = Vector6::Zero();  ///< of the sensor at that time, m/s and rad/s in its own frame
  bool matched = false;             ///< false: the pose is the guess
  int points = 0;                   ///< that were to be matched
  int matches = 0;                  ///< of them found a surface
  int agreeing = 0;                 ///< of these lie within 3 sigmas of it
  int iterations = 0;
  double rmse = 0.0;  ///< m, of the matched points with their robust weights
  Matrix6 covariance =
      Matrix6::Zero();  ///< of the perturbation of core/pose.hpp; the prior's if not matched
  Localizability localizability;
};

/// What is known of a scan's pose before it is matched.
struct ScanGuess {
  Pose T_map_lidar = Pose::Identity();         ///< at the scan's reference time, by the odometry
  Pose T_map_predicted = Pose::Identity();     ///< the same if the last motion goes on
  Pose T_previous_current = Pose::Identity();  ///< motion since the previous scan
  double seconds = 0.1;                        ///< of that motion
  bool measured = true;  ///< by the odometry; false: the pose is the prediction
};

/// Scan-to-map refinement, paper 2.3 (4).
class Mapper {
 public:
  /// `range_noise` in m, one sigma; `row_spacing` in rad, see LocalMap.
  Mapper(const MappingSettings& settings, double range_noise, double row_spacing = 0.0);

  /// Matches the large feature sets with the map. The motion within the sweep is estimated with the
  /// pose; the motion since the previous scan is what is known of it beforehand.
  MapMatch refine(const Features& features, const ScanGuess& guess);

  /// rad; error of the elevation angles that the scans so far have shown, see ElevationBias. 0 when
  /// it is not to be estimated.
  double elevation_bias() const { return elevation_bias_.value(); }

  /// rad; the same of each row beside what they have in common, see RowBias; empty when unknown.
  const std::vector<double>& row_bias() const { return row_bias_.values(); }

  /// Whether the times of the points fit the motion.
  const SweepCheck& sweep_check() const { return sweep_check_; }

  /// Adds features that are already de-skewed.
  void insert(const Features& deskewed, const Pose& T_map_lidar);

  /// Adds those of the present scan, unless the sensor has hardly moved since the last ones: what
  /// it sees while it stands adds nothing but the pattern of its beams. Forgets what is out of
  /// reach.
  void add_scan(const Features& deskewed, const Pose& T_map_lidar);

  void clear();
  bool empty() const { return map_.size() == 0; }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(map_, elevation_bias_, row_bias_, sweep_check_, spacing_, last_insertion_,
            last_eviction_);
  }

 private:
  void adapt_spacing(int points);

  MappingSettings settings_;
  double range_noise_;
  LocalMap map_;
  ElevationBias elevation_bias_;
  RowBias row_bias_;
  SweepCheck sweep_check_;
  double spacing_;  // m, of the points that are matched
  std::optional<Eigen::Vector3d> last_insertion_;
  Eigen::Vector3d last_eviction_ = Eigen::Vector3d::Zero();
};

}  // namespace lego_loam_sc
