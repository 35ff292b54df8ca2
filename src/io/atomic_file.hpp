// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace lego_loam_sc {

/// A file that is there as a whole or not at all: written beside its place under a temporary name
/// and moved into place by `commit`. Without `commit` nothing is left. Every step throws
/// InputError when the disk is full or the folder cannot be written.
class AtomicFile {
 public:
  /// The file at `path` stays as it is until `commit`.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Adds bytes at the end.
  void write(std::string_view bytes);
  /// Puts bytes over those that were written first.
  void overwrite_beginning(std::string_view bytes);
  /// Moves the file into its place.
  void commit();

 private:
  void discard();
  [[noreturn]] void fail(int error);

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::FILE* file_ = nullptr;
};

/// `bytes` as the whole content of the file at `path`.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace lego_loam_sc
