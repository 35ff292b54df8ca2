// SPDX-License-Identifier: BSD-3-Clause
#include "app/recording_reader.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "app/companion.hpp"
#include "core/error.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kFiles = {".bag", ".active", ".pcap", ".pcapng"};
// ROS 2 bags are such files, or folders with them.
constexpr std::array<std::string_view, 3> kRos2Files = {".mcap", ".db3", ".zstd"};

template <std::size_t N>
bool has_extension(const fs::path& path, const std::array<std::string_view, N>& extensions) {
  return std::find(extensions.begin(), extensions.end(), path.extension()) != extensions.end();
}

void make_standard_input(int file) {
  dup2(file, STDIN_FILENO);
  close(file);
}

}  // namespace

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
  std::vector<std::string> arguments;
  if (topic) arguments.insert(arguments.end(), {"--topic", *topic});
  if (quiet) arguments.emplace_back("--quiet");
  arguments.insert(arguments.end(), {"--", input});

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
  const int error = start_program(find_program("lego-loam-sc-read"), std::move(arguments), process_,
                                  &files, &attributes);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  make_standard_input(ends[0]);
  close(ends[1]);
  if (error != 0)
    throw InputError(input + " is read " + explain_no_start("lego-loam-sc-read", error));
}

int RecordingReader::wait() {
  make_standard_input(
      open("/dev/null", O_RDONLY));  // so that the program does not block on a full pipe
  return wait_for(std::exchange(process_, -1));
}

}  // namespace lego_loam_sc
