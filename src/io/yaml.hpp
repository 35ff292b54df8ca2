// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lego_loam_sc {

/// One `key: value` of a YAML file.
struct YamlEntry {
  std::string key;                  ///< with its groups, dotted
  std::vector<std::string> values;  ///< one, or the entries of a list
  bool is_list = false;
  std::string where;  ///< "FILE, line N", for messages
};

/// The entries of a YAML map in file order. Strict: a duplicate key, a nested list, an alias, an
/// empty value or a second document is an InputError that names file and line.
std::vector<YamlEntry> parse_yaml(const std::string& text, const std::string& file);

// The value of an entry. Each throws InputError with the key, the invalid value and what is
// allowed.
bool to_bool(const YamlEntry& entry);
int to_int(const YamlEntry& entry, int minimum, int maximum);
double to_double(const YamlEntry& entry, double minimum, double maximum);
double to_double(const YamlEntry& entry);
const std::string& to_string(const YamlEntry& entry);
std::vector<double> to_doubles(const YamlEntry& entry);

/// Throws InputError: `entry` is not one of `keys`; names the nearest of them.
[[noreturn]] void fail_unknown_key(const YamlEntry& entry, std::span<const std::string> keys);

}  // namespace lego_loam_sc
