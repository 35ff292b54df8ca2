// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/mapper.hpp"
#include "tracking/settings.hpp"

namespace lego_loam_sc {

/// Decides scan by scan whether the place of the sensor is known. Odometry tells it from the last
/// one; after a gap, or when odometry fails, only the map does.
class TrackingMonitor {
 public:
  /// The place is known.
  explicit TrackingMonitor(const TrackingSettings& settings) : settings_(settings) {}

  /// Before a scan: the clock has jumped by `jump_s`, the last scan that was matched is `seconds`
  /// old.
  void note_gap(double jump_s, double seconds);

  /// Whether the odometry and the map together tell the place of a scan.
  bool place_is_known(bool odometry_solved, const MapMatch& match);

  /// The place has been unknown for TrackingSettings::patience scans in a row: the map does not
  /// hold it.
  bool should_start_new_map() const;

  /// The place is known again.
  void clear() { *this = TrackingMonitor(settings_); }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(after_gap_, lost_scans_);
  }

 private:
  TrackingSettings settings_;
  bool after_gap_ = false;  // only the map can tell the place
  int lost_scans_ = 0;      // in a row, without those of too few points
};

}  // namespace lego_loam_sc
