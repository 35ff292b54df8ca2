// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace lego_loam_sc {

/// A file that grows line by line and is whole after each: what a killed run leaves behind can be
/// read. Throws InputError when the file cannot be made or written.
class AppendFile {
 public:
  /// Goes on with a file that is there.
  explicit AppendFile(std::filesystem::path path);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// `lines` end with a line feed. When this fails, the file is cut to the lines before and closed.
  void append(std::string_view lines);

  /// Cuts the file to its first `size` bytes.
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
