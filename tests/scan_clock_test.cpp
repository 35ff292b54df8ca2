// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/scan_clock.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace lego_loam_sc {
namespace {

constexpr std::int64_t kStep = 100'000'000;
constexpr std::int64_t kHour = 3'600'000'000'000;
constexpr std::int64_t kStart = 1'700'000'000'000'000'000;

// Times in steps after the first; -1 for a scan that is not taken.
std::vector<double> steps(const std::vector<std::int64_t>& stamps, int* jumps = nullptr) {
  ScanClock clock(0.1);
  std::vector<double> result;
  for (const std::int64_t stamp : stamps) {
    const auto time = clock.read(stamp);
    result.push_back(time ? static_cast<double>(time->time_ns - stamps[0]) / kStep : -1.0);
    if (jumps && time && time->jump_s != 0.0) ++*jumps;
  }
  return result;
}

std::vector<std::int64_t> at(const std::vector<std::int64_t>& offsets) {
  std::vector<std::int64_t> stamps;
  for (const std::int64_t offset : offsets) stamps.push_back(kStart + offset);
  return stamps;
}

TEST(ScanClock, FollowsStampsThatGoForwardThroughShortGaps) {
  int jumps = 0;
  EXPECT_EQ(steps(at({0, kStep, 2 * kStep, 52 * kStep, 53 * kStep}), &jumps),
            (std::vector<double>{0, 1, 2, 52, 53}));
  EXPECT_EQ(jumps, 0);
}

TEST(ScanClock, DoesNotTakeScansThatRepeatOrComeLate) {
  EXPECT_EQ(steps(at({0, kStep, kStep, 0, 2 * kStep, -kStep, 3 * kStep})),
            (std::vector<double>{0, 1, -1, -1, 2, -1, 3}));
}

TEST(ScanClock, GoesOnByOneStepWhenStampsJumpForGood) {
  for (const std::int64_t jump : {kHour, -kHour, 10 * kStep * 10, -15 * kStep}) {
    int jumps = 0;
    EXPECT_EQ(steps(at({0, kStep, 2 * kStep + jump, 3 * kStep + jump, 3 * kStep + jump}), &jumps),
              (std::vector<double>{0, 1, 2, 3, -1}))
        << jump;
    EXPECT_EQ(jumps, 1);
  }
}

TEST(ScanClock, ReturnsToTheStampsAfterOneThatAloneWasWrong) {
  for (const std::int64_t jump : {kHour, -kHour}) {
    int jumps = 0;
    EXPECT_EQ(steps(at({0, kStep, 2 * kStep + jump, 5 * kStep, 6 * kStep}), &jumps),
              (std::vector<double>{0, 1, 2, 5, 6}));
    EXPECT_EQ(jumps, 2);
  }
}

TEST(ScanClock, SaysHowFarItJumped) {
  ScanClock clock(0.1);
  clock.read(kStart);
  EXPECT_DOUBLE_EQ(clock.read(kStart + kHour)->jump_s, 3600.0);
  EXPECT_DOUBLE_EQ(clock.read(kStart + kStep)->jump_s, 0.1 - 3600.0);
}

TEST(ScanClock, TheOrdinaryStepIsThatOfTheStamps) {
  EXPECT_EQ(steps(at({0, 2 * kStep, 4 * kStep + kHour})), (std::vector<double>{0, 2, 4}));
}

TEST(ScanClock, DoesNotOverflow) {
  const std::int64_t far = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(steps({far, -far - 1}), (std::vector<double>{-1, -1}));
  const std::int64_t bound = 4'600'000'000'000'000'000;
  ScanClock clock(0.1);
  EXPECT_EQ(clock.read(-bound)->time_ns, -bound);
  EXPECT_EQ(clock.read(bound)->time_ns, -bound + kStep);
  EXPECT_EQ(clock.read(-bound)->time_ns, -bound + 2 * kStep);
}

}  // namespace
}  // namespace lego_loam_sc
