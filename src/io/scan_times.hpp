// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lego_loam_sc {

/// The stamps (ns) in the text of a times.txt: one number per line, the seconds of a scan; blank
/// lines do not count. Throws InputError that names `file` and the line when one is anything else.
std::vector<std::int64_t> parse_scan_times(std::string_view text, const std::string& file);

}  // namespace lego_loam_sc
