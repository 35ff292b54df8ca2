// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lego_loam_sc {

// Locale-independent parsing and formatting.

/// Removes the next line from the front of `rest` and returns it without its end (LF or CR LF).
std::string_view take_line(std::string_view& rest);

/// Removes the next word (between white space) from the front of `rest`; empty at the end.
std::string_view take_word(std::string_view& rest);

/// Parses all of `text` as a number, or nothing. NaN and infinity are numbers.
std::optional<double> parse_double(std::string_view text);

/// Parses decimal seconds as nanoseconds, exact to nine decimals for present-day stamps; nothing
/// when `text` is not a number or does not fit.
std::optional<std::int64_t> parse_seconds(std::string_view text);

/// Parses all of `text` as an integer, or nothing when it is none or does not fit.
template <class Integer>
std::optional<Integer> parse_integer(std::string_view text) {
  Integer value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// The shortest text that parses to the same number.
/// @{
std::string to_text(double value);
std::string to_text(int value);
/// @}

/// `value` with this many decimals.
std::string to_fixed(double value, int decimals);

/// Nanoseconds as seconds with nine decimals, exact.
std::string to_seconds(std::int64_t nanoseconds);

/// The name with the smallest edit distance to `name`. The trailing parts of dotted names are
/// compared too: `treshold` finds `loop.scan_context.threshold`. `names` must not be empty.
std::string nearest_name(std::string_view name, std::span<const std::string> names);

/// Natural order: runs of digits compare as numbers, so that scan_9 precedes scan_10.
bool natural_less(std::string_view a, std::string_view b);

/// "a, b, c"
std::string join(std::span<const std::string> words);

}  // namespace lego_loam_sc
