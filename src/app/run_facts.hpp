// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/trajectory.hpp"
#include "slam/report.hpp"
#include "slam/run_verdict.hpp"

namespace lego_loam_sc {

/// A trajectory to compare with, and the file that it is from.
struct NamedTruth {
  std::string file;
  PoseFile poses;
};

/// What `summary.json` says of a run that the SLAM does not know.
struct RunFacts {
  std::string input;
  std::string method;
  std::string sensor;
  int threads = 1;
  double wall_seconds = 0.0;
  bool interrupted = false;
  std::vector<std::string> faults;  ///< of the input, a sentence each
  std::vector<std::string> notes;   ///< what was assumed of the input, a sentence each
  std::optional<NamedTruth> truth;
};

/// Counts of the scans and loops of a run by outcome.
struct RunCounts {
  std::size_t scans = 0;
  std::size_t accepted_loops = 0;
  std::size_t refused_loops = 0;
  std::map<std::string, std::size_t> statuses;  ///< scans with each Status
  std::size_t stamp_jumps = 0;
  int first_jump_scan = 0;
  double first_jump_s = 0.0;
  RunAssessment assessment;

  /// Counts the next scan.
  void add(const ScanReport& report);

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(scans, accepted_loops, refused_loops, statuses, stamp_jumps, first_jump_scan,
            first_jump_s, assessment);
  }
};

}  // namespace lego_loam_sc
