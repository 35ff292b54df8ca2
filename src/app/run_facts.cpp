// SPDX-License-Identifier: BSD-3-Clause
#include "app/run_facts.hpp"

namespace lego_loam_sc {

void RunCounts::add(const ScanReport& report) {
  assessment.add(report);
  ++scans;
  ++statuses[std::string(to_string(report.status))];
  for (const LoopReport& loop : report.loops)
    ++(loop.verification.verdict == Verdict::accepted ? accepted_loops : refused_loops);
  if (report.stamp_jump_s != 0.0 && stamp_jumps++ == 0) {
    first_jump_scan = report.index;
    first_jump_s = report.stamp_jump_s;
  }
}

}  // namespace lego_loam_sc
