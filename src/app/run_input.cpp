// SPDX-License-Identifier: BSD-3-Clause
#include "app/run_input.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "app/interrupt.hpp"

namespace lego_loam_sc {

RunInput::RunInput(const InputOptions& options, std::optional<std::size_t> count, bool quiet)
    : options_(options), count_(count), input_(options, quiet) {
  for (std::size_t k = 0; k < options.first; ++k)
    if (!read_next(input_.source())) break;
}

std::optional<ScanOrFault> RunInput::take() {
  if (count_ && taken_ == *count_) return std::nullopt;
  std::optional<ScanOrFault> item = prefetcher_ ? prefetcher_->next() : read_next(input_.source());
  at_end_ = !item && !interrupted();
  if (item) ++taken_;
  return item;
}

void RunInput::note(const std::string& fault) {
  spdlog::error("{}", fault);
  faults_.push_back(fault);
}

std::optional<Scan> RunInput::next() {
  while (auto item = take()) {
    if (auto* scan = std::get_if<Scan>(&*item)) return std::move(*scan);
    if (interrupted()) return std::nullopt;  // the signal ended the read: no fault of the input
    note(std::get<std::string>(*item));
  }
  return std::nullopt;
}

std::deque<Scan> RunInput::leading() {
  constexpr std::size_t kMinPoints = 1000;  // to recognise a sensor by
  std::deque<Scan> scans;
  while (scans.empty() || scans.back().size() < kMinPoints) {
    std::optional<Scan> scan = next();
    if (!scan) break;
    scans.push_back(std::move(*scan));
  }
  return scans;
}

std::optional<std::int64_t> RunInput::skip_to(std::size_t taken, std::vector<std::string> faults) {
  std::optional<std::int64_t> stamp_ns;
  while (taken_ < taken) {
    const std::optional<ScanOrFault> item = take();
    if (!item) break;
    if (const auto* scan = std::get_if<Scan>(&*item)) stamp_ns = scan->stamp_ns;
  }
  faults_ = std::move(faults);
  return stamp_ns;
}

bool RunInput::finish_reader() {
  const int exit_code = at_end_ ? input_.wait_for_reader() : 0;
  if (exit_code == 1)  // it has printed the reason
    faults_.push_back(options_.input +
                      " was not read in full, see the message of lego-loam-sc-read");
  else if (exit_code != 0)
    note(options_.input + ": lego-loam-sc-read failed with code " + std::to_string(exit_code) +
         "; the scans read before that are used");
  return exit_code == 0;
}

std::optional<std::size_t> RunInput::expected() const {
  const std::optional<std::size_t> size = input_.source().size();
  if (!size) return count_;
  const std::size_t rest = *size - std::min(*size, options_.first);
  return count_ ? std::min(rest, *count_) : rest;
}

}  // namespace lego_loam_sc
