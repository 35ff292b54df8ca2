// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace lego_loam_sc {

/// The whole content of a file. Throws InputError that names the file when it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace lego_loam_sc
