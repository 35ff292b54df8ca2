// SPDX-License-Identifier: BSD-3-Clause
#include "io/file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.hpp"

namespace lego_loam_sc {
namespace {

// Limit for pipes and for files that grow while they are read.
constexpr std::size_t kMaxExtraBytes = 64 << 20;

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw InputError(path.string() + " cannot be read: " + std::strerror(errno));
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) fail(path);
  std::setvbuf(file.get(), nullptr, _IONBF, 0);  // the whole file is read at once
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  const std::size_t expected = unknown ? 0 : static_cast<std::size_t>(size);
  // One byte more than the file has: a read that does not fill the buffer has reached the end.
  std::string bytes(expected + 1, '\0');
  std::size_t used = 0;
  for (;;) {
    const std::size_t room = bytes.size() - used;
    const std::size_t got = std::fread(bytes.data() + used, 1, room, file.get());
    used += got;
    if (got < room) break;
    if (used > expected + kMaxExtraBytes)
      throw InputError(path.string() +
                       " yields more bytes than its size; give a file, not a device");
    bytes.resize(2 * bytes.size());
  }
  if (std::ferror(file.get())) fail(path);
  bytes.resize(used);
  return bytes;
}

}  // namespace lego_loam_sc
