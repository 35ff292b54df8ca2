// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "core/map_point.hpp"
#include "io/atomic_file.hpp"

namespace lego_loam_sc {

// Binary little-endian files. They replace an old file at once and throw InputError when that
// fails.

/// What CloudFile writes.
enum class CloudFormat { ply, pcd };

/// x y z (m), intensity (float32) and key_frame (int32) of points that come bit by bit.
class CloudFile {
 public:
  /// Throws InputError when it cannot be made.
  CloudFile(const std::filesystem::path& path, CloudFormat format);

  /// Adds points at the end.
  void add(std::span<const MapPoint> points);
  /// Only now the file is there.
  void commit();

 private:
  AtomicFile file_;
  CloudFormat format_;
  std::size_t count_ = 0;
};

/// The same of points that are all at hand, as PLY.
void write_ply(const std::filesystem::path& path, std::span<const MapPoint> points);

/// A PLY file of any properties: their lines in the header, each with its end of line, and the
/// bytes of `count` points, of which each holds them in that order without padding.
void write_ply(const std::filesystem::path& path, std::string_view properties, std::size_t count,
               std::string_view bytes);

}  // namespace lego_loam_sc
