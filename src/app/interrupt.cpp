// SPDX-License-Identifier: BSD-3-Clause
#include "app/interrupt.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace lego_loam_sc {
namespace {

// The signal may come to one thread and be looked for by another.
std::atomic<bool> asked_to_end = false;
static_assert(std::atomic<bool>::is_always_lock_free);
int nothing_to_read = -1;  // a file that is at its end

void ask_to_end(int number) {
  asked_to_end = true;
  dup2(nothing_to_read, STDIN_FILENO);  // for a read that begins between this and the next look
  signal(number, SIG_DFL);
}

void do_nothing(int) {}

// Without SA_RESTART, so that a read which waits for the next scan of a stream ends.
void handle(int number, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigaction(number, &action, nullptr);
}

}  // namespace

void catch_interrupts() {
  nothing_to_read = open("/dev/null", O_RDONLY | O_CLOEXEC);
  handle(SIGINT, ask_to_end);
  handle(SIGTERM, ask_to_end);
}

bool interrupted() {
  return asked_to_end;
}

void end_read(std::thread& thread) {
  handle(SIGUSR1, do_nothing);
  pthread_kill(thread.native_handle(), SIGUSR1);
}

}  // namespace lego_loam_sc
