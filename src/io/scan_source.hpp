// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scan.hpp"
#include "io/dataset_facts.hpp"

namespace lego_loam_sc {

/// A sequence of scans from any kind of input.
class ScanSource {
 public:
  virtual ~ScanSource() = default;

  /// The next scan, or nothing after the last. Throws InputError when that scan is invalid; the
  /// next call continues with the one after it.
  virtual std::optional<Scan> next() = 0;

  /// The number of scans, if known in advance.
  virtual std::optional<std::size_t> size() const { return std::nullopt; }

  /// Facts about the data set.
  const DatasetFacts& facts() const { return facts_; }

  /// Assumptions about stamps and point times, one sentence each; `next` may add some.
  const std::vector<std::string>& notes() const { return notes_; }

 protected:
  DatasetFacts facts_;
  std::vector<std::string> notes_;
};

/// Opens a KITTI sequence folder, a folder of .bin, .pcd or .ply scans, a single scan, a file with
/// a scan stream, or `-` for a scan stream on standard input. Throws InputError for anything else.
///
/// Scans of a folder come in natural order of their names. Their stamps are those of times.txt, one
/// line per scan, in seconds; without it they come from absolute point times, or else are 0.1 s
/// apart.
std::unique_ptr<ScanSource> open_scans(const std::string& input);

/// Parses times.txt: one number per line, the stamp of a scan in seconds; blank lines are ignored.
/// Returns nanoseconds. Throws InputError that names `file` and the line for anything else.
std::vector<std::int64_t> parse_scan_times(std::string_view text, const std::string& file);

}  // namespace lego_loam_sc
