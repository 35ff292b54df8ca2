// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/scan_input.hpp"
#include "app/scan_prefetcher.hpp"
#include "core/scan.hpp"
#include "io/scan_source.hpp"

namespace lego_loam_sc {

/// The scans of a run: those of its input from --first on, at most --count of them. What is wrong
/// with the input is said as it comes and remembered, but ends nothing.
class RunInput {
 public:
  /// `count`: as --count. Throws InputError when the input cannot be opened.
  RunInput(const InputOptions& options, std::optional<std::size_t> count, bool quiet);

  /// Reads on a thread of its own from now on, which also changes the notes of the source.
  void read_ahead() { prefetcher_.emplace(input_.source()); }

  /// The next good scan; nothing after the last and once the run is interrupted.
  std::optional<Scan> next();

  /// The scans up to the first that shows enough to tell the sensor by: a recording may start
  /// blind.
  std::deque<Scan> leading();

  /// Goes on where another run was that had taken `taken` scans and seen these faults, and says
  /// none of them again. Returns the stamp of the last scan that it passes, if any.
  std::optional<std::int64_t> skip_to(std::size_t taken, std::vector<std::string> faults);

  /// Ends the reader of a recording once its scans are. False when it had a fault.
  bool finish_reader();

  /// What was assumed of the scans, see ScanSource. Ends the reading ahead: no scan comes after it.
  const std::vector<std::string>& final_notes() {
    prefetcher_.reset();
    return input_.source().notes();
  }

  /// How many scans were taken, bad ones among them.
  std::size_t taken() const { return taken_; }
  /// How many are to be expected in all, when that is known.
  std::optional<std::size_t> expected() const;
  /// What was wrong, a sentence each.
  const std::vector<std::string>& faults() const { return faults_; }
  const ScanSource& source() const { return input_.source(); }

 private:
  std::optional<ScanOrFault> take();
  void note(const std::string& fault);

  InputOptions options_;
  std::optional<std::size_t> count_;
  ScanInput input_;
  std::optional<ScanPrefetcher> prefetcher_;
  std::size_t taken_ = 0;
  bool at_end_ = false;
  std::vector<std::string> faults_;
};

}  // namespace lego_loam_sc
