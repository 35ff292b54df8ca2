// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracking_monitor.hpp"

namespace lego_loam_sc {
namespace {

// Outliers match anywhere; in a wrong place both shares are low. In the right place one of them may
// be, where the map is young or the ground rough.
constexpr double kAgreement = 0.85;  // of the matched points
constexpr double kConfirmed = 0.5;   // of all points

bool confirms(const MapMatch& match) {
  return match.matched && (match.inliers >= kAgreement * match.matches ||
                           match.inliers >= kConfirmed * match.points);
}

}  // namespace

void TrackingMonitor::note_gap(double jump_s, double seconds) {
  after_gap_ |= jump_s != 0.0 || seconds > settings_.max_gap;
}

// For a few scans odometry alone may tell the place, as long as the map does not contradict it.
bool TrackingMonitor::place_is_known(bool odometry_solved, const MapMatch& match) {
  const bool odometry_tells =
      odometry_solved && !after_gap_ && (lost_scans_ == 0 || !match.matched);
  const bool confirmed = confirms(match);
  if (confirmed) after_gap_ = false;
  lost_scans_ = confirmed || odometry_tells ? 0 : lost_scans_ + 1;
  return lost_scans_ == 0;
}

bool TrackingMonitor::should_start_new_map() const {
  return lost_scans_ == settings_.patience;
}

}  // namespace lego_loam_sc
