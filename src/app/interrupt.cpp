// SPDX-License-Identifier: BSD-3-Clause
#include "app/interrupt.hpp"

#include <csignal>

namespace lego_loam_sc {
namespace {

volatile std::sig_atomic_t asked_to_end = 0;

void ask_to_end(int signal) {
  asked_to_end = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, ask_to_end);
  std::signal(SIGTERM, ask_to_end);
}

bool interrupted() { return asked_to_end != 0; }

}  // namespace lego_loam_sc
