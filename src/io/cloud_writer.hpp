// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "core/map_point.hpp"
#include "io/atomic_file.hpp"

namespace lego_loam_sc {

// Binary little-endian files. They replace an existing file atomically and throw InputError when
// that fails.

/// File format of CloudFile.
enum class CloudFormat { ply, pcd };

/// Writes a cloud incrementally: x y z (m), intensity (float32) and key_frame (int32) per point.
class CloudFile {
 public:
  /// Throws InputError when the file cannot be created.
  CloudFile(const std::filesystem::path& path, CloudFormat format);

  /// Appends points.
  void add(std::span<const MapPoint> points);
  /// Completes the file, which does not exist before.
  void commit();

 private:
  AtomicFile file_;
  CloudFormat format_;
  std::size_t count_ = 0;
};

/// Writes a whole cloud as PLY.
void write_ply(const std::filesystem::path& path, std::span<const MapPoint> points);

/// Writes a PLY file with any properties: their header lines, each with its line end, and the bytes
/// of `count` points, each with its properties in that order without padding.
void write_ply(const std::filesystem::path& path, std::string_view properties, std::size_t count,
               std::string_view bytes);

}  // namespace lego_loam_sc
