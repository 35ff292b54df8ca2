// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace lego_loam_sc {

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), temporary_(path_.string() + ".part") {
  file_ = std::fopen(temporary_.c_str(), "wb");
  if (!file_) fail(errno);
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::write(std::string_view bytes) {
  if (bytes.empty()) return;  // data() may be null, which fwrite does not accept
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(errno);
}

void AtomicFile::overwrite_beginning(std::string_view bytes) {
  if (std::fseek(file_, 0, SEEK_SET) != 0) fail(errno);
  write(bytes);
  if (std::fseek(file_, 0, SEEK_END) != 0) fail(errno);
}

void AtomicFile::commit() {
  // A full disk may be reported only when fclose flushes the last buffer.
  if (std::fclose(std::exchange(file_, nullptr)) != 0 ||
      std::rename(temporary_.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    std::remove(temporary_.c_str());
    fail(error);
  }
}

void AtomicFile::discard() {
  if (!file_) return;
  std::fclose(std::exchange(file_, nullptr));
  std::remove(temporary_.c_str());
}

void AtomicFile::fail(int error) {
  discard();
  throw InputError(path_.string() + " cannot be written: " + std::strerror(error));
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace lego_loam_sc
