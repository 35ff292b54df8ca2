// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/raw_scan.hpp"

namespace lego_loam_sc {

/// Reads the element `vertex` of a PLY file, format `ascii`, `binary_little_endian` or
/// `binary_big_endian`, with properties of any scalar type. Elements before it are skipped, those
/// after it ignored. Throws InputError when the header is invalid or the data shorter than
/// declared.
RawScan read_ply(const std::filesystem::path& path);

/// The same for the bytes of a file; `file` names them in messages.
RawScan parse_ply(std::string_view bytes, const std::string& file);

}  // namespace lego_loam_sc
