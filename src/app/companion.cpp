// SPDX-License-Identifier: BSD-3-Clause
#include "app/companion.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace lego_loam_sc {

std::string find_program(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {here, here / "../../python/.venv/bin"})
    if (access((folder / name).c_str(), X_OK) == 0) return (folder / name).string();
  return name;
}

int start_program(const std::string& program, std::vector<std::string> arguments, pid_t& process,
                  const posix_spawn_file_actions_t* files, const posix_spawnattr_t* attributes) {
  arguments.insert(arguments.begin(), program);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  return posix_spawnp(&process, program.c_str(), files, attributes, argv.data(), environ);
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string explain_no_start(const std::string& name, int error) {
  return "by the companion package, and " + name + " does not start (" + std::strerror(error) +
         "); install it with scripts/setup, or with pip install . in the repository";
}

}  // namespace lego_loam_sc
