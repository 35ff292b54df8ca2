// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lego_loam_sc {

// Text in and out that is the same in every locale.

/// Takes the next line, without its end (LF or CR LF), off the front of `rest`.
std::string_view take_line(std::string_view& rest);

/// Takes the next word between blanks or line ends off the front of `rest`; empty at its end.
std::string_view take_word(std::string_view& rest);

/// The number that is all of `text`, or nothing. NaN and infinity are numbers.
std::optional<double> parse_double(std::string_view text);

/// Decimal seconds as nanoseconds, exact for nine decimals in this age; nothing when `text` is no
/// number or does not fit.
std::optional<std::int64_t> parse_seconds(std::string_view text);

/// The whole number that is all of `text`, or nothing when it is none or does not fit.
template <class Integer>
std::optional<Integer> parse_integer(std::string_view text) {
  Integer value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// The shortest form that reads back as the same number.
/// @{
std::string to_text(double value);
std::string to_text(int value);
/// @}

/// `value` with this many decimals.
std::string to_fixed(double value, int decimals);

/// Nanoseconds as seconds with nine decimals, exact.
std::string to_seconds(std::int64_t nanoseconds);

/// The name with the least edit distance to `name`; for dotted names the trailing parts alone are
/// compared too, so that `treshold` finds `loop.scan_context.threshold`. `names` is not empty.
std::string nearest_name(std::string_view name, std::span<const std::string> names);

/// "a, b, c"
std::string join(std::span<const std::string> words);

}  // namespace lego_loam_sc
