// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "slam/report.hpp"

namespace lego_loam_sc {

/// Whether the trajectory and the map of a run are to be believed.
enum class Trust { trusted, doubtful, failed };

/// As it stands in summary.json.
constexpr std::string_view to_string(Trust trust) {
  switch (trust) {
    case Trust::trusted: return "trusted";
    case Trust::doubtful: return "doubtful";
    case Trust::failed: return "failed";
  }
  return "unknown";
}

/// Why a run is not trusted.
struct DoubtReason {
  std::string text;         ///< a sentence without its full stop
  int scans = 0;            ///< that it holds for
  int first = 0, last = 0;  ///< of them
};

/// The verdict on a run and its reasons; none when it is trusted.
struct RunVerdict {
  Trust trust = Trust::trusted;
  std::vector<DoubtReason> reasons;
};

/// Follows the reports of a run and judges it. Single bad scans are bridged and cost nothing; what
/// lasts casts doubt on all that comes after it. docs/reliability.md says how often it is right.
class RunAssessment {
 public:
  /// The next scan.
  void add(const ScanReport& report);

  /// So far. `maps`: see Slam::maps.
  RunVerdict verdict(int maps) const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(scans_, unplaced_, degenerate_, contradicted_);
  }

 private:
  // Scans to which something applies, and the longest row of them.
  struct Stretch {
    int scans = 0;
    int longest = 0;
    int first = 0, last = 0;
    int current = 0;

    void add(bool applies, int scan);
    DoubtReason reason(std::string text) const { return {std::move(text), scans, first, last}; }

    template <class Archive>
    void state(Archive& archive) {
      archive(scans, longest, first, last, current);
    }
  };

  int scans_ = 0;
  Stretch unplaced_;      // matched neither the map nor the scan before
  Stretch degenerate_;    // held by the prediction alone in some direction
  Stretch contradicted_;  // by the free space of key frames, see Testimony
};

/// The verdict as one sentence for the terminal.
std::string describe(const RunVerdict& verdict);

}  // namespace lego_loam_sc
