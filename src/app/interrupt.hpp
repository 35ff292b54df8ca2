// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <thread>

namespace lego_loam_sc {

/// Makes SIGINT and SIGTERM ask for an orderly end; a second one ends the process at once.
void catch_interrupts();

/// True once an end was asked for.
bool interrupted();

/// Makes a read that `thread` waits in return. One that only begins now is not reached: call again
/// until the thread shows that it went on.
void end_read(std::thread& thread);

}  // namespace lego_loam_sc
