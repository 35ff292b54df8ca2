// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace lego_loam_sc {

/// Storage for bytes that are written once and rarely read: the points of all key frames, which
/// take most of the memory of a run. The application provides one that uses a file
/// (io/blob_file.hpp).
class BlobStore {
 public:
  virtual ~BlobStore() = default;

  virtual std::uint64_t size() const = 0;  ///< bytes
  /// Appends bytes.
  virtual void append(std::span<const std::byte> bytes) = 0;
  /// Reads from `offset` into `bytes`; they must have been appended in one call.
  virtual void read(std::uint64_t offset, std::span<std::byte> bytes) const = 0;
  /// Removes all bytes.
  virtual void clear() = 0;
};

/// A store in memory.
class MemoryBlobs : public BlobStore {
 public:
  std::uint64_t size() const override { return bytes_.size(); }
  void append(std::span<const std::byte> bytes) override {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void read(std::uint64_t offset, std::span<std::byte> bytes) const override {
    if (!bytes.empty()) std::memcpy(bytes.data(), bytes_.data() + offset, bytes.size());
  }
  void clear() override { bytes_.clear(); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace lego_loam_sc
