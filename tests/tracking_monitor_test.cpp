// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracking_monitor.hpp"

#include <gtest/gtest.h>

namespace lego_loam_sc {
namespace {

MapMatch matched(int inliers) {
  MapMatch match;
  match.matched = true;
  match.points = 100;
  match.matches = 80;
  match.inliers = inliers;
  return match;
}

const MapMatch kConfirmed = matched(75);
const MapMatch kContradicted = matched(30);
const MapMatch kUnmatched;

TEST(TrackingMonitor, TheOdometryAloneTellsThePlaceAsLongAsNothingIsInDoubt) {
  TrackingMonitor monitor{TrackingSettings{}};
  EXPECT_TRUE(monitor.place_is_known(true, kUnmatched));
  EXPECT_TRUE(monitor.place_is_known(true, kContradicted));
  EXPECT_FALSE(monitor.place_is_known(false, kUnmatched));
}

TEST(TrackingMonitor, AfterAGapOnlyTheMapTellsThePlace) {
  for (const auto& [jump_s, seconds] : {std::pair(3600.0, 0.1), std::pair(0.0, 10.0)}) {
    TrackingMonitor monitor{TrackingSettings{}};
    monitor.note_gap(jump_s, seconds);
    EXPECT_FALSE(monitor.place_is_known(true, kUnmatched));
    EXPECT_FALSE(monitor.place_is_known(true, kContradicted));
    EXPECT_TRUE(monitor.place_is_known(false, kConfirmed));
    EXPECT_TRUE(monitor.place_is_known(true, kUnmatched));
  }
}

TEST(TrackingMonitor, AFewScansGapIsNone) {
  TrackingMonitor monitor{TrackingSettings{}};
  monitor.note_gap(0.0, 0.5);
  EXPECT_TRUE(monitor.place_is_known(true, kUnmatched));
}

// Once lost, a scan that the map contradicts is no better for an odometry that goes on.
TEST(TrackingMonitor, WhoIsLostIsFoundByTheMapOrByAnOdometryThatItDoesNotContradict) {
  TrackingMonitor monitor{TrackingSettings{}};
  EXPECT_FALSE(monitor.place_is_known(false, kUnmatched));
  EXPECT_FALSE(monitor.place_is_known(true, kContradicted));
  EXPECT_TRUE(monitor.place_is_known(true, kUnmatched));
  EXPECT_FALSE(monitor.place_is_known(false, kContradicted));
  EXPECT_TRUE(monitor.place_is_known(false, kConfirmed));
}

TEST(TrackingMonitor, PatienceEndsAfterTenScansInARow) {
  TrackingMonitor monitor{TrackingSettings{}};
  for (int scan = 0; scan < 9; ++scan) monitor.place_is_known(false, kUnmatched);
  EXPECT_FALSE(monitor.should_start_new_map());
  monitor.place_is_known(false, kUnmatched);
  EXPECT_TRUE(monitor.should_start_new_map());
  monitor.clear();
  EXPECT_FALSE(monitor.should_start_new_map());
  EXPECT_TRUE(monitor.place_is_known(true, kUnmatched));
}

}  // namespace
}  // namespace lego_loam_sc
