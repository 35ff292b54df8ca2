// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

namespace lego_loam_sc {

/// A progress bar on standard error when that is a terminal, otherwise a line every ten seconds.
class Progress {
 public:
  /// `total` is the number of steps when it is known; `quiet` shows nothing.
  Progress(std::optional<std::size_t> total, bool quiet);
  ~Progress();

  void step();

 private:
  using Clock = std::chrono::steady_clock;

  void show() const;

  std::optional<std::size_t> total_;
  bool quiet_;
  bool terminal_;
  std::size_t done_ = 0;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point shown_ = begin_;
};

}  // namespace lego_loam_sc
