// SPDX-License-Identifier: BSD-3-Clause
#include "loop/search_pacing.hpp"

#include <gtest/gtest.h>

namespace lego_loam_sc {
namespace {

// m from a loop to the next search, after so many redundant loops in a row.
double spacing_after(int redundant, double loops_near) {
  SearchPacing pacing(1.0);
  pacing.on_added(0.0);
  for (int k = 0; k < redundant; ++k) pacing.on_redundant(0.0, loops_near);
  double metres = 0.0;
  while (pacing.pauses(metres)) metres += 0.5;
  return metres;
}

TEST(SearchPacing, ALoopOrARefusalPausesForTheSpacing) {
  SearchPacing pacing(3.0);
  EXPECT_FALSE(pacing.pauses(0.0));
  pacing.on_added(10.0);
  EXPECT_EQ(pacing.since_last_loop(12.0), 2.0);
  EXPECT_TRUE(pacing.pauses(12.9));
  EXPECT_FALSE(pacing.pauses(13.0));
  pacing.on_refused(20.0);
  EXPECT_EQ(pacing.since_last_loop(20.0), 10.0);
  EXPECT_TRUE(pacing.pauses(22.9));
  EXPECT_FALSE(pacing.pauses(23.0));
}

TEST(SearchPacing, RedundantLoopsDoubleTheSpacingUpToALimit) {
  EXPECT_EQ(spacing_after(0, 0.0), 1.0);
  EXPECT_EQ(spacing_after(1, 0.0), 2.0);
  EXPECT_EQ(spacing_after(2, 0.0), 4.0);
  EXPECT_EQ(spacing_after(3, 0.0), 6.0);
  EXPECT_EQ(spacing_after(9, 0.0), 6.0);
}

TEST(SearchPacing, WhereManyLoopsEndTheLimitIsHigher) {
  EXPECT_EQ(spacing_after(9, 5.0), 12.0);
  EXPECT_EQ(spacing_after(9, 1000.0), 24.0);
}

}  // namespace
}  // namespace lego_loam_sc
