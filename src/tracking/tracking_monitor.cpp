// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracking_monitor.hpp"

namespace lego_loam_sc {
namespace {

// Without sight for so long, s, the sensor may be anywhere.
constexpr double kLongestBlindness = 1.0;
// Something always matches, even far from where the map was made. There a fifth or more of what is
// matched lies beside its surface, and fewer than two of five points lie on one. In the right place
// either may be so, where the map is young or the ground rough, but not both.
constexpr double kAgreement = 0.85;  // of the matched points
constexpr double kConfirmed = 0.5;   // of all points
constexpr int kPatience = 10;        // scans

bool confirms(const MapMatch& match) {
  return match.matched && (match.inliers >= kAgreement * match.matches ||
                           match.inliers >= kConfirmed * match.points);
}

}  // namespace

void TrackingMonitor::note_gap(double jump_s, double seconds) {
  in_doubt_ |= jump_s != 0.0 || seconds > kLongestBlindness;
}

// A few scans after the last whose place was known the odometry alone may tell it, as long as the
// map does not contradict.
bool TrackingMonitor::place_is_known(bool odometry_solved, const MapMatch& match) {
  const bool told = odometry_solved && !in_doubt_ && (lost_scans_ == 0 || !match.matched);
  const bool confirmed = confirms(match);
  if (confirmed) in_doubt_ = false;
  lost_scans_ = confirmed || told ? 0 : lost_scans_ + 1;
  return lost_scans_ == 0;
}

bool TrackingMonitor::should_start_new_map() const {
  return lost_scans_ == kPatience;
}

}  // namespace lego_loam_sc
