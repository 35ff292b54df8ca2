// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace lego_loam_sc {

/// Orders names as people do: runs of digits by their number, so that scan_9 comes before scan_10.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace lego_loam_sc
