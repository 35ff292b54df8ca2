// SPDX-License-Identifier: BSD-3-Clause
#include "app/interrupt.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace lego_loam_sc {
namespace {

// Set by a signal handler on any thread, read by others.
std::atomic<bool> end_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);
int dev_null = -1;

void request_end(int number) {
  end_requested = true;
  dup2(dev_null, STDIN_FILENO);  // so that a read which begins before the flag is seen ends at once
  signal(number, SIG_DFL);
}

void do_nothing(int) {}

// Without SA_RESTART, so that a blocked read of a stream returns.
void handle(int number, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigaction(number, &action, nullptr);
}

}  // namespace

void catch_interrupts() {
  dev_null = open("/dev/null", O_RDONLY | O_CLOEXEC);
  handle(SIGINT, request_end);
  handle(SIGTERM, request_end);
}

bool interrupted() {
  return end_requested;
}

void end_read(std::thread& thread) {
  handle(SIGUSR1, do_nothing);
  pthread_kill(thread.native_handle(), SIGUSR1);
}

}  // namespace lego_loam_sc
