// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace lego_loam_sc {

/// The threads that work may be spread over.
class WorkerThreads {
 public:
  /// At most so many, with the caller's; one at least.
  explicit WorkerThreads(int count);
  WorkerThreads(WorkerThreads&&) noexcept;
  WorkerThreads& operator=(WorkerThreads&&) noexcept;
  ~WorkerThreads();

  /// Does the work and returns what it gives.
  template <class Work>
  auto run(Work&& work) {
    std::optional<decltype(work())> result;
    execute([&] { result.emplace(work()); });
    return std::move(*result);
  }

 private:
  void execute(const std::function<void()>& work);

  class Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace lego_loam_sc
