// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/mapper.hpp"

namespace lego_loam_sc {

/// Whether it is known where the sensor is, scan by scan. The odometry tells its motion; after a
/// gap, or when it fails, only the map can tell the place.
class TrackingMonitor {
 public:
  /// Before a scan: the clock has jumped by `jump_s`, the last scan that was matched is `seconds`
  /// old.
  void note_gap(double jump_s, double seconds);

  /// Whether the odometry and the map together tell the place of a scan.
  bool place_is_known(bool odometry_solved, const MapMatch& match);

  /// The place has been unknown for so many scans that the map does not hold it.
  bool should_start_new_map() const;

  void clear() { *this = {}; }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(in_doubt_, lost_scans_);
  }

 private:
  bool in_doubt_ = false;  // the motion does not tell the place, the map has to
  int lost_scans_ = 0;     // in a row; blind ones do not count
};

}  // namespace lego_loam_sc
