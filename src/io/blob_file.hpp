// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "core/blob_store.hpp"

namespace lego_loam_sc {

/// Keeps the bytes in a file that the destructor removes; bytes that do not fit on the disk stay in
/// memory. Throws InputError when the file cannot be created or read.
class BlobFile : public BlobStore {
 public:
  /// Truncates an existing file.
  explicit BlobFile(std::filesystem::path path);
  ~BlobFile() override;
  BlobFile(const BlobFile&) = delete;
  BlobFile& operator=(const BlobFile&) = delete;

  std::uint64_t size() const override { return in_file_ + overflow_.size(); }
  void append(std::span<const std::byte> bytes) override;
  void read(std::uint64_t offset, std::span<std::byte> bytes) const override;
  void clear() override;

 private:
  [[noreturn]] void fail(const char* what, int error) const;

  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t in_file_ = 0;
  std::vector<std::byte> overflow_;
};

}  // namespace lego_loam_sc
