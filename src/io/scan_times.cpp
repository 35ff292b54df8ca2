// SPDX-License-Identifier: BSD-3-Clause
#include "io/scan_times.hpp"

#include "core/error.hpp"
#include "core/text.hpp"

namespace lego_loam_sc {

std::vector<std::int64_t> parse_scan_times(std::string_view text, const std::string& file) {
  std::vector<std::int64_t> stamps;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = take_line(text);
    const std::string_view word = take_word(line);
    if (word.empty()) continue;
    const auto stamp = parse_seconds(word);
    if (!stamp || !take_word(line).empty())
      throw InputError(file + ", line " + std::to_string(number) +
                       ": one number is expected, the seconds of a scan");
    stamps.push_back(*stamp);
  }
  return stamps;
}

}  // namespace lego_loam_sc
