// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "core/scan.hpp"
#include "io/scan_source.hpp"

namespace lego_loam_sc {

/// A scan, or the reason why it could not be read.
using ScanOrFault = std::variant<Scan, std::string>;

/// Reads ahead on a thread of its own, a few scans at most.
class ScanPrefetcher {
 public:
  explicit ScanPrefetcher(ScanSource& source);
  ~ScanPrefetcher();
  ScanPrefetcher(const ScanPrefetcher&) = delete;
  ScanPrefetcher& operator=(const ScanPrefetcher&) = delete;

  /// The next scan or fault in the order of the source; nothing after the last one or when the wait
  /// for it is interrupted.
  std::optional<ScanOrFault> next();

 private:
  static constexpr std::size_t kAhead = 4;

  void read(ScanSource& source);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ScanOrFault> queue_;
  bool ended_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

/// One step of reading, for the prefetcher and for a run without it.
std::optional<ScanOrFault> read_next(ScanSource& source);

}  // namespace lego_loam_sc
