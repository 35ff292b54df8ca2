// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/map_point.hpp"

namespace lego_loam_sc {

// Binary little-endian files. They replace an old file at once and throw InputError when that
// fails.

/// x y z (m), intensity (float32) and key_frame (int32) of each point.
void write_ply(const std::filesystem::path& path, const std::vector<MapPoint>& points);
void write_pcd(const std::filesystem::path& path, const std::vector<MapPoint>& points);

/// A PLY file of any properties: their lines in the header, each with its end of line, and the
/// bytes of `count` points, of which each holds them in that order without padding.
void write_ply(const std::filesystem::path& path, std::string_view properties, std::size_t count,
               std::string_view bytes);

}  // namespace lego_loam_sc
