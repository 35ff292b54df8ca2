// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <thread>

namespace lego_loam_sc {

/// Makes SIGINT and SIGTERM request an orderly end; a second one ends the process at once.
void catch_interrupts();

/// True once an end was requested.
bool interrupted();

/// Makes a blocked read of `thread` return. A read that begins after the call is not affected: call
/// again until the thread has gone on.
void end_read(std::thread& thread);

}  // namespace lego_loam_sc
