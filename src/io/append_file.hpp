// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace lego_loam_sc {

/// A file that grows line by line and is valid after each line, so that the output of a killed run
/// can be read. Throws InputError when the file cannot be created or written.
class AppendFile {
 public:
  /// Appends to an existing file.
  explicit AppendFile(std::filesystem::path path);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// `lines` end with a line feed. On failure the file is truncated to the previous lines and
  /// closed.
  void append(std::string_view lines);

  /// Truncates the file to its first `size` bytes.
  void cut(std::size_t size);

  std::size_t size() const { return size_; }

  /// See core/state_archive.hpp: how much of the file belongs to the state.
  template <class Archive>
  void state(Archive& archive) {
    std::size_t size = size_;
    archive(size);
    if constexpr (Archive::kReads) cut(size);
  }

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace lego_loam_sc
