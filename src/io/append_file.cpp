// SPDX-License-Identifier: BSD-3-Clause
#include "io/append_file.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.hpp"

namespace lego_loam_sc {

AppendFile::AppendFile(std::filesystem::path path) : path_(std::move(path)) {
  file_ = std::fopen(path_.c_str(), "ab");
  if (!file_) fail(errno);
  size_ = std::filesystem::file_size(path_);
}

AppendFile::~AppendFile() {
  if (file_) std::fclose(file_);
}

void AppendFile::append(std::string_view lines) {
  if (std::fwrite(lines.data(), 1, lines.size(), file_) == lines.size() &&
      std::fflush(file_) == 0) {
    size_ += lines.size();
    struct stat status;
    if (::fstat(::fileno(file_), &status) == 0 && status.st_nlink == 0)
      throw InputError(path_.string() +
                       ": was removed while it was written; start again in another folder");
    return;
  }
  const int error = errno;
  std::fclose(std::exchange(file_, nullptr));  // flushes once more, before the truncation
  // A full disk may have accepted a part of a line.
  std::error_code gone;
  std::filesystem::resize_file(path_, size_, gone);
  fail(error);
}

void AppendFile::cut(std::size_t size) {
  if (size > size_)
    throw InputError(path_.string() + ": has lost its end; start the run again in another folder");
  std::error_code error;
  std::filesystem::resize_file(path_, size, error);
  if (error) fail(error.value());
  size_ = size;
}

void AppendFile::fail(int error) const {
  throw InputError(path_.string() + ": cannot be written (" + std::strerror(error) +
                   "); free space or choose another folder with -o");
}

}  // namespace lego_loam_sc
