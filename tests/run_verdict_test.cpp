// SPDX-License-Identifier: BSD-3-Clause
#include "slam/run_verdict.hpp"

#include <gtest/gtest.h>

namespace lego_loam_sc {
namespace {

ScanReport scan(int index, Status status = Status::ok, int contradicting = 0) {
  ScanReport report;
  report.index = index;
  report.status = status;
  report.agreeing = 400 - contradicting;
  report.contradicting = contradicting;
  return report;
}

// 100 scans, those from `first` on as `bad` says, so many.
RunVerdict verdict_with(int count, int first, const ScanReport& bad, int maps = 1) {
  RunAssessment assessment;
  for (int k = 0; k < 100; ++k) {
    ScanReport report = k >= first && k < first + count ? bad : scan(k);
    report.index = k;
    assessment.add(report);
  }
  return assessment.verdict(maps);
}

TEST(RunVerdict, AGoodRunIsTrusted) {
  const RunVerdict verdict = verdict_with(0, 0, scan(0));
  EXPECT_EQ(verdict.trust, Trust::trusted);
  EXPECT_TRUE(verdict.reasons.empty());
  EXPECT_EQ(describe(verdict), "verdict: trusted");
}

TEST(RunVerdict, AFewBadScansAreBridged) {
  EXPECT_EQ(verdict_with(4, 50, scan(0, Status::lost)).trust, Trust::trusted);
  EXPECT_EQ(verdict_with(4, 50, scan(0, Status::ok, 200)).trust, Trust::trusted);
  EXPECT_EQ(verdict_with(40, 30, scan(0, Status::degenerate)).trust, Trust::trusted);
}

TEST(RunVerdict, WhatLastsCastsDoubtAndIsNamed) {
  const RunVerdict verdict = verdict_with(6, 50, scan(0, Status::lost));
  EXPECT_EQ(verdict.trust, Trust::doubtful);
  ASSERT_EQ(verdict.reasons.size(), 1u);
  EXPECT_EQ(verdict.reasons[0].scans, 6);
  EXPECT_EQ(verdict.reasons[0].first, 50);
  EXPECT_EQ(verdict.reasons[0].last, 55);
  EXPECT_NE(describe(verdict).find("6 scans from 50 to 55"), std::string::npos);
  EXPECT_EQ(verdict_with(6, 50, scan(0, Status::ok, 200)).trust, Trust::doubtful);
  EXPECT_EQ(verdict_with(60, 30, scan(0, Status::degenerate)).trust, Trust::doubtful);
  EXPECT_EQ(verdict_with(0, 0, scan(0), 2).trust, Trust::doubtful);
}

TEST(RunVerdict, MostlyLostIsFailed) {
  EXPECT_EQ(verdict_with(30, 10, scan(0, Status::lost)).trust, Trust::failed);
}

TEST(RunVerdict, RepeatedScansAndThoseOutOfOrderAreNoScans) {
  EXPECT_EQ(verdict_with(60, 10, scan(0, Status::repeated)).trust, Trust::trusted);
  EXPECT_EQ(verdict_with(60, 10, scan(0, Status::out_of_order)).trust, Trust::trusted);
}

}  // namespace
}  // namespace lego_loam_sc
