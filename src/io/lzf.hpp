// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lego_loam_sc {

/// Decompresses LZF data, the compression of PCD's `binary_compressed`. Nothing when the data is
/// corrupt or does not yield exactly `size` bytes.
std::optional<std::string> decompress_lzf(std::string_view data, std::size_t size);

}  // namespace lego_loam_sc
