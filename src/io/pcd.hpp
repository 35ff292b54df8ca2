// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/raw_scan.hpp"

namespace lego_loam_sc {

/// Reads a PCD file, version 0.5 to 0.7, with data `ascii`, `binary` or `binary_compressed`, and
/// fields of any type (https://pointclouds.org/documentation/tutorials/pcd_file_format.html).
/// Organised clouds become a list row by row; VIEWPOINT is ignored, as is customary. Throws
/// InputError when the header is invalid or does not match the data.
RawScan read_pcd(const std::filesystem::path& path);

/// The same for the bytes of a file; `file` names them in messages.
RawScan parse_pcd(std::string_view bytes, const std::string& file);

}  // namespace lego_loam_sc
