// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

namespace lego_loam_sc {

/// The threads that work may be spread over.
class WorkerThreads {
 public:
  /// At most so many, with the caller's; one at least.
  explicit WorkerThreads(int count);
  WorkerThreads(WorkerThreads&&) noexcept;
  WorkerThreads& operator=(WorkerThreads&&) noexcept;
  ~WorkerThreads();

  /// Does the work and returns when it is done.
  void run(const std::function<void()>& work);

 private:
  class Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace lego_loam_sc
