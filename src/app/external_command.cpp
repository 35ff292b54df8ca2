// SPDX-License-Identifier: BSD-3-Clause
#include "app/external_command.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <vector>

#include "io/error.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kFiles = {".bag", ".active", ".pcap", ".pcapng"};
constexpr std::array<std::string_view, 3> kRos2Files = {".mcap", ".db3",
                                                        ".zstd"};  // or in a folder

template <std::size_t N>
bool has_extension(const fs::path& path, const std::array<std::string_view, N>& extensions) {
  return std::find(extensions.begin(), extensions.end(), path.extension()) != extensions.end();
}

// A path, or the name alone for the search in PATH.
std::string find_program(const std::string& name) {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {here, here / "../../python/.venv/bin"})
    if (access((folder / name).c_str(), X_OK) == 0) return (folder / name).string();
  return name;
}

std::vector<char*> to_argv(std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return arguments;
}

// As a shell would tell it.
int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void make_standard_input(int file) {
  dup2(file, STDIN_FILENO);
  close(file);
}

}  // namespace

bool is_known_verb(const CLI::App& app, const std::string& word) {
  if (word.empty() || word.front() == '-' || word.find('/') != word.npos) return true;
  return !app.get_subcommands([&](const CLI::App* sub) { return sub->check_name(word); }).empty();
}

void run_external(char** argv) {
  char* const verb = argv[1];
  std::string program = find_program(std::string("lego-loam-sc-") + verb);
  argv[1] = program.data();
  execvp(program.c_str(), argv + 1);
  argv[1] = verb;
}

bool make_report(const std::string& folder, bool quiet) {
  std::fflush(stdout);  // what was said before comes before
  std::vector<std::string> words = {find_program("lego-loam-sc-report")};
  if (quiet) words.emplace_back("--quiet");
  words.insert(words.end(), {"--", folder});
  std::vector<char*> arguments = to_argv(words);
  pid_t process = -1;
  const int error =
      posix_spawnp(&process, words.front().c_str(), nullptr, nullptr, arguments.data(), environ);
  if (error != 0)
    throw InputError(
        folder +
        " is complete but for the report: it is made by the companion package, and "
        "lego-loam-sc-report does not start (" +
        std::strerror(error) +
        "); install it with scripts/setup, or with pip install . in the repository, and call "
        "lego-loam-sc report " +
        folder);
  return wait_for(process) == 0;
}

bool is_recording(const std::string& input) {
  std::error_code error;
  if (!fs::is_directory(input, error))
    return fs::exists(input, error) &&
           (has_extension(input, kFiles) || has_extension(input, kRos2Files));
  for (fs::directory_iterator entry(input, error), end; !error && entry != end;
       entry.increment(error))
    if (has_extension(entry->path(), kRos2Files)) return true;
  return false;
}

RecordingReader::RecordingReader(const std::string& input, const std::optional<std::string>& topic,
                                 bool quiet) {
  std::string program = find_program("lego-loam-sc-read");
  std::vector<std::string> words = {program};
  if (topic) words.insert(words.end(), {"--topic", *topic});
  if (quiet) words.emplace_back("--quiet");
  words.insert(words.end(), {"--", input});
  std::vector<char*> arguments = to_argv(words);

  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw InputError(std::string("no pipe to lego-loam-sc-read: ") + std::strerror(errno));
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
  // A group of its own: Ctrl-C is for this program, which then stops reading.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error =
      posix_spawnp(&process_, program.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  make_standard_input(ends[0]);
  close(ends[1]);
  if (error != 0)
    throw InputError(input +
                     " is read by the companion package, and lego-loam-sc-read does not "
                     "start (" +
                     std::strerror(error) +
                     "); install it with scripts/setup, or with pip install . in the repository");
}

int RecordingReader::wait() {
  make_standard_input(open("/dev/null", O_RDONLY));  // it must not wait for us to read on
  return wait_for(process_);
}

}  // namespace lego_loam_sc
