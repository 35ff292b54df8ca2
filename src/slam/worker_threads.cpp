// SPDX-License-Identifier: BSD-3-Clause
#include "slam/worker_threads.hpp"

#include <tbb/task_arena.h>

#include <algorithm>

namespace lego_loam_sc {

class WorkerThreads::Arena : public tbb::task_arena {
 public:
  using tbb::task_arena::task_arena;
};

WorkerThreads::WorkerThreads(int count) : arena_(std::make_unique<Arena>(std::max(count, 1))) {}
WorkerThreads::WorkerThreads(WorkerThreads&&) noexcept = default;
WorkerThreads& WorkerThreads::operator=(WorkerThreads&&) noexcept = default;
WorkerThreads::~WorkerThreads() = default;

void WorkerThreads::execute(const std::function<void()>& work) {
  arena_->execute(work);
}

}  // namespace lego_loam_sc
