// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace lego_loam_sc {

/// A file that is written completely or not at all: under a temporary name in the same folder,
/// renamed by `commit`. Without `commit` nothing is left. Every step throws InputError when the
/// disk is full or the folder cannot be written.
class AtomicFile {
 public:
  /// An existing file at `path` is unchanged until `commit`.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes.
  void write(std::string_view bytes);
  /// Overwrites the first bytes.
  void overwrite_beginning(std::string_view bytes);
  /// Renames the file to its final path.
  void commit();

 private:
  void discard();
  [[noreturn]] void fail(int error);

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::FILE* file_ = nullptr;
};

/// Writes `bytes` as the content of the file at `path`, atomically.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace lego_loam_sc
