// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scan.hpp"
#include "io/dataset_facts.hpp"

namespace lego_loam_sc {

/// Scans one after another, wherever they come from.
class ScanSource {
 public:
  virtual ~ScanSource() = default;

  /// The next scan, nothing after the last. Throws InputError when that scan is bad; a further call
  /// goes on with the one behind it.
  virtual std::optional<Scan> next() = 0;

  /// The number of scans, when it is known beforehand.
  virtual std::optional<std::size_t> size() const { return std::nullopt; }

  /// What is known of the scans besides them.
  const DatasetFacts& facts() const { return facts_; }

  /// What was assumed about stamps and times of points, a sentence each; may grow with `next`.
  const std::vector<std::string>& notes() const { return notes_; }

 protected:
  DatasetFacts facts_;
  std::vector<std::string> notes_;
};

/// Opens a KITTI sequence folder, a folder of .bin, .pcd or .ply scans, one such scan, a file with
/// a scan stream, or `-` for a scan stream on standard input. Throws InputError that says what to
/// do when it is none of these.
///
/// Scans of a folder come in the natural order of their names. Their stamps are the seconds in
/// times.txt, one line per scan; without it absolute times of the points give them, or else they
/// are 0.1 s apart.
std::unique_ptr<ScanSource> open_scans(const std::string& input);

}  // namespace lego_loam_sc
