// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/sweep_unit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lego_loam_sc {
namespace {

SweepUnit after(int scans, double gap, double span, double period = 0.1) {
  SweepUnit unit(period);
  for (int k = 0; k < scans; ++k) unit.add(std::llround(1e9 * gap * k), span);
  return unit;
}

TEST(SweepUnit, LeavesSweepsAloneThatFit) {
  for (const double span : {0.0, 0.02, 0.1, 0.105, 0.14}) {
    const SweepUnit unit = after(10, 0.1, span);
    EXPECT_EQ(unit.factor(), 1.0);
    EXPECT_EQ(unit.too_long(), 0);
  }
}

TEST(SweepUnit, CorrectsPowersOfTenFromTheSecondScanOn) {
  EXPECT_EQ(after(1, 0.1, 1.0).factor(), 1.0);
  EXPECT_DOUBLE_EQ(after(2, 0.1, 0.98).factor(), 0.1);
  EXPECT_DOUBLE_EQ(after(5, 0.05, 0.49).factor(), 0.1);
  EXPECT_DOUBLE_EQ(after(5, 0.002, 2.0, 0.002).factor(), 0.001);
}

TEST(SweepUnit, OnlySaysWhatIsAmbiguous) {
  const SweepUnit unit = after(10, 0.1, 0.3);
  EXPECT_EQ(unit.factor(), 1.0);
  EXPECT_EQ(unit.too_long(), 9);
  EXPECT_EQ(unit.compared(), 9);
}

TEST(SweepUnit, OneBurstOfScansIsNoUnit) {
  SweepUnit unit(0.1);
  std::int64_t stamp_ns = 0;
  for (int k = 0; k < 20; ++k) {
    stamp_ns += k == 1 || k == 10 ? 10'000'000 : 100'000'000;  // they were received together
    unit.add(stamp_ns, 0.1);
    EXPECT_EQ(unit.factor(), 1.0);
  }
}

}  // namespace
}  // namespace lego_loam_sc
