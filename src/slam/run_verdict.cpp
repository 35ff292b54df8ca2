// SPDX-License-Identifier: BSD-3-Clause
#include "slam/run_verdict.hpp"

#include <algorithm>

namespace lego_loam_sc {
namespace {

// At a right pose up to a tenth of the witnesses contradict, which are on what moves; at a wrong
// one a quarter and more.
constexpr double kContradiction = 0.15;
// Scans in a row that cast doubt. So long the prediction bridges a gap: at the accelerations of
// vehicles it is off by a few decimetres after half a second.
constexpr int kLasting = 5;
// Shares of the scans: unplaced, of a failed run; contradicted or degenerate, of a doubtful one.
constexpr double kFailedShare = 0.2;
constexpr double kContradictedShare = 0.05;
constexpr double kDegenerateShare = 0.5;

double share(int part, int whole) {
  return whole > 0 ? static_cast<double>(part) / whole : 0.0;
}

}  // namespace

void RunAssessment::Stretch::add(bool applies, int scan) {
  current = applies ? current + 1 : 0;
  if (!applies) return;
  if (scans++ == 0) first = scan;
  last = scan;
  longest = std::max(longest, current);
}

void RunAssessment::add(const ScanReport& report) {
  if (report.status == Status::out_of_order || report.status == Status::repeated) return;
  ++scans_;
  unplaced_.add(!is_placed(report.status), report.index);
  degenerate_.add(report.status == Status::degenerate, report.index);
  const Testimony testimony{report.agreeing, report.contradicting};
  contradicted_.add(testimony.contradiction() > kContradiction, report.index);
}

RunVerdict RunAssessment::verdict(int maps) const {
  RunVerdict verdict;
  const auto doubt = [&](Trust trust, DoubtReason reason) {
    verdict.trust = std::max(verdict.trust, trust);
    verdict.reasons.push_back(std::move(reason));
  };
  if (share(unplaced_.scans, scans_) > kFailedShare)
    doubt(Trust::failed, unplaced_.reason("the place of many scans is not known"));
  else if (unplaced_.longest >= kLasting)
    doubt(Trust::doubtful, unplaced_.reason("for a while the place was not known"));
  if (maps > 1)
    doubt(Trust::doubtful,
          {std::to_string(maps) + " maps that no loop joins: their relative poses are a guess",
           scans_, 0, scans_ - 1});
  if (contradicted_.longest >= kLasting || share(contradicted_.scans, scans_) > kContradictedShare)
    doubt(Trust::doubtful,
          contradicted_.reason("many points lie where earlier scans saw free space: the poses are "
                               "wrong, or much of what is seen moves with the sensor"));
  if (degenerate_.scans >= kLasting && share(degenerate_.scans, scans_) > kDegenerateShare)
    doubt(Trust::doubtful,
          degenerate_.reason("most of the drive is held by the prediction alone in some direction, "
                             "as in a tunnel without features"));
  return verdict;
}

std::string describe(const RunVerdict& verdict) {
  if (verdict.trust == Trust::trusted) return "verdict: trusted";
  std::string text = "verdict: " + std::string(to_string(verdict.trust)) + ": ";
  for (std::size_t i = 0; i < verdict.reasons.size(); ++i) {
    const DoubtReason& reason = verdict.reasons[i];
    text += (i > 0 ? "; " : "") + reason.text + " (" + std::to_string(reason.scans) +
            " scans from " + std::to_string(reason.first) + " to " + std::to_string(reason.last) +
            ")";
  }
  return text;
}

}  // namespace lego_loam_sc
