// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/scan.hpp"

namespace lego_loam_sc {

/// Reads a KITTI .bin file: float32 x y z (m) and intensity per point, little-endian. An empty file
/// is a scan without points. Throws InputError when the size is not a multiple of 16 bytes.
Scan read_bin(const std::filesystem::path& path);

/// The same for the bytes of a file; `file` names them in messages.
Scan parse_bin(std::string_view bytes, const std::string& file);

}  // namespace lego_loam_sc
