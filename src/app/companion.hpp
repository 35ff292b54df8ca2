// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <string>
#include <vector>

namespace lego_loam_sc {

// Programs of the companion package, python/, as children of this one.

/// The path of a program beside this one or in the virtual environment of the checkout that this
/// one was built in; otherwise its name, to be searched in PATH.
std::string find_program(const std::string& name);

/// Starts a program, by its path or its name in PATH, with these arguments. Returns 0, or the error
/// number when it does not start.
int start_program(const std::string& program, std::vector<std::string> arguments, pid_t& process,
                  const posix_spawn_file_actions_t* files = nullptr,
                  const posix_spawnattr_t* attributes = nullptr);

/// Waits for the end of a child. Returns its exit code, or 128 and the number of the signal that
/// ended it, as a shell does.
int wait_for(pid_t process);

/// The end of a sentence: "by the companion package, and NAME does not start (...); install it
/// ...".
std::string explain_no_start(const std::string& name, int error);

}  // namespace lego_loam_sc
