// SPDX-License-Identifier: BSD-3-Clause
#include "app/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace lego_loam_sc {

Progress::Progress(std::optional<std::size_t> total, bool quiet)
    : total_(total), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (quiet_ || !terminal_ || done_ == 0) return;
  show();
  std::fputc('\n', stderr);
}

void Progress::step() {
  ++done_;
  if (quiet_) return;
  const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::seconds(10);
  if (Clock::now() - shown_ < interval) return;
  shown_ = Clock::now();
  show();
}

void Progress::show() const {
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const double rate = seconds > 0.0 ? static_cast<double>(done_) / seconds : 0.0;
  std::string line = std::to_string(done_);
  if (total_ && *total_ > 0) {
    constexpr std::size_t kWidth = 30;
    const std::size_t filled = kWidth * done_ / *total_;
    line += "/" + std::to_string(*total_);
    if (terminal_)
      line = "[" + std::string(filled, '#') + std::string(kWidth - filled, '.') + "] " + line;
  }
  std::fprintf(stderr, terminal_ ? "\r%s scans, %.0f per second " : "%s scans, %.0f per second\n",
               line.c_str(), rate);
}

}  // namespace lego_loam_sc
