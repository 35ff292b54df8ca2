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

/// The scans of a run: those of its input from --first on, at most --count of them. Faults of the
/// input are printed as they occur and collected; the run goes on.
class RunInput {
 public:
  /// `count`: as --count. Throws InputError when the input cannot be opened.
  RunInput(const InputOptions& options, std::optional<std::size_t> count, bool quiet);

  /// Reads on a thread of its own from now on, which also writes the notes of the source.
  void read_ahead() { prefetcher_.emplace(input_.source()); }

  /// The next good scan; nothing after the last and once the run is interrupted.
  std::optional<Scan> next();

  /// The scans up to the first with enough points to recognise the sensor: the first ones of a
  /// recording may be nearly empty.
  std::deque<Scan> leading();

  /// Skips the `taken` scans of an earlier run and takes over its faults without printing them
  /// again. Returns the stamp of the last scan skipped, if any.
  std::optional<std::int64_t> skip_to(std::size_t taken, std::vector<std::string> faults);

  /// Ends the reader of a recording after its last scan. False when it reported a fault.
  bool finish_reader();

  /// What was assumed of the scans, see ScanSource. Ends the reading ahead: no scan comes after it.
  const std::vector<std::string>& final_notes() {
    prefetcher_.reset();
    return input_.source().notes();
  }

  /// Number of scans taken, bad ones included.
  std::size_t taken() const { return taken_; }
  /// Number of scans expected in all, when known.
  std::optional<std::size_t> expected() const;
  /// Faults so far, a sentence each.
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
