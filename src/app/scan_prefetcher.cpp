// SPDX-License-Identifier: BSD-3-Clause
#include "app/scan_prefetcher.hpp"

#include <chrono>
#include <utility>

#include "app/interrupt.hpp"
#include "core/error.hpp"

namespace lego_loam_sc {
namespace {

// A signal does not notify a condition variable, so waiting is polled.
constexpr std::chrono::milliseconds kPollInterval(50);

}  // namespace

std::optional<ScanOrFault> read_next(ScanSource& source) {
  try {
    if (std::optional<Scan> scan = source.next()) return ScanOrFault(std::move(*scan));
    return std::nullopt;
  } catch (const InputError& error) {
    return ScanOrFault(std::string(error.what()));
  }
}

ScanPrefetcher::ScanPrefetcher(ScanSource& source) : thread_([this, &source] { read(source); }) {}

ScanPrefetcher::~ScanPrefetcher() {
  std::unique_lock lock(mutex_);
  stopping_ = true;
  changed_.notify_all();
  // A read of a stream may block for ever.
  while (!changed_.wait_for(lock, kPollInterval, [&] { return ended_; })) end_read(thread_);
  lock.unlock();
  thread_.join();
}

std::optional<ScanOrFault> ScanPrefetcher::next() {
  std::unique_lock lock(mutex_);
  const auto ready = [&] { return !queue_.empty() || ended_; };
  while (!changed_.wait_for(lock, kPollInterval, ready))
    if (interrupted()) return std::nullopt;
  if (queue_.empty()) return std::nullopt;
  ScanOrFault front = std::move(queue_.front());
  queue_.pop_front();
  changed_.notify_all();
  return front;
}

void ScanPrefetcher::read(ScanSource& source) {
  while (true) {
    std::optional<ScanOrFault> item = read_next(source);
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return queue_.size() < kAhead || stopping_; });
    if (!item || stopping_) {
      ended_ = true;
      changed_.notify_all();
      return;
    }
    queue_.push_back(std::move(*item));
    changed_.notify_all();
  }
}

}  // namespace lego_loam_sc
