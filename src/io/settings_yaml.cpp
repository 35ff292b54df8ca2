// SPDX-License-Identifier: BSD-3-Clause
#include "io/settings_yaml.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/file.hpp"
#include "io/presets.hpp"
#include "io/yaml.hpp"

namespace lego_loam_sc {
namespace {

// Calls visit(group, name, value, ...) for every setting, with its limits and comment.
template <class SettingsOrConst, class Visit>
void visit_all(SettingsOrConst& settings, Visit&& visit) {
  Settings::groups(settings, [&](const std::string& group, auto& section) {
    visit_settings(section, [&](const char* name, auto&&... value_and_facts) {
      visit(group, name, value_and_facts...);
    });
  });
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  const Settings settings;
  visit_all(settings, [&](const std::string& group, const char* name, const auto&...) {
    keys.push_back(group + "." + name);
  });
  return keys;
}

struct Setter {
  const YamlEntry& entry;
  bool found = false;

  void operator()(const std::string& group, const char* name, bool& value, const char*) {
    if (matches(group, name)) value = to_bool(entry);
  }
  void operator()(const std::string& group, const char* name, int& value, int minimum, int maximum,
                  const char*) {
    if (matches(group, name)) value = to_int(entry, minimum, maximum);
  }
  void operator()(const std::string& group, const char* name, double& value, double minimum,
                  double maximum, const char*) {
    if (matches(group, name)) value = to_double(entry, minimum, maximum);
  }

  bool matches(const std::string& group, const char* name) {
    const bool same = entry.key == group + "." + name;
    found = found || same;
    return same;
  }
};

void apply(const YamlEntry& entry, Settings& settings) {
  Setter setter{entry};
  visit_all(settings, setter);
  if (!setter.found) fail_unknown_key(entry, all_keys());
}

// A method may be based on another one, whose settings come first.
void apply_method(const std::string& method, Settings& settings) {
  const auto preset = find_preset("methods", method);
  if (!preset) throw InputError("there is no method " + describe_unknown("methods", method));
  const std::vector<YamlEntry> entries = parse_yaml(*preset, "the preset " + method);
  const auto is_base = [](const YamlEntry& entry) { return entry.key == "base"; };
  for (const YamlEntry& entry : entries)
    if (is_base(entry)) apply_method(to_string(entry), settings);
  for (const YamlEntry& entry : entries)
    if (!is_base(entry)) apply(entry, settings);
}

void apply_assignment(const std::string& assignment, Settings& settings) {
  const std::size_t sign = assignment.find('=');
  if (sign == assignment.npos || sign == 0 || sign + 1 == assignment.size())
    throw InputError("--set " + assignment + " is not of the form key=value");
  apply({assignment.substr(0, sign), {assignment.substr(sign + 1)}, false, "--set " + assignment},
        settings);
}

// Writes the head of a group before its first setting; loop.scan_context is nested in loop.
class Printer {
 public:
  void operator()(const std::string& group, const char* name, bool value, const char* comment) {
    print(group, name, value ? "true" : "false", comment);
  }
  template <class Number>
  void operator()(const std::string& group, const char* name, Number value, Number, Number,
                  const char* comment) {
    print(group, name, to_text(value), comment);
  }

  std::string text;

 private:
  void print(const std::string& group, const char* name, const std::string& value,
             const char* comment) {
    const auto depth = static_cast<std::size_t>(std::count(group.begin(), group.end(), '.'));
    const std::string indent(2 * depth, ' ');
    if (group != group_) text += indent + group.substr(group.rfind('.') + 1) + ":\n";
    group_ = group;
    text += indent + "  " + name + ": " + value + "  # " + comment + "\n";
  }

  std::string group_;
};

}  // namespace

void apply_settings_yaml(const std::string& text, const std::string& file, Settings& settings) {
  for (const YamlEntry& entry : parse_yaml(text, file)) apply(entry, settings);
}

Settings load_settings(const std::string& method,
                       const std::optional<std::filesystem::path>& config_file,
                       const std::vector<std::string>& assignments) {
  Settings settings;
  apply_method(method, settings);
  if (config_file) apply_settings_yaml(read_file(*config_file), config_file->string(), settings);
  for (const std::string& assignment : assignments) apply_assignment(assignment, settings);
  // Single values were checked with their line; this checks their combination.
  if (const auto fault = validate(settings)) throw InputError(*fault);
  return settings;
}

std::string to_yaml(const Settings& settings) {
  Printer printer;
  visit_all(settings, printer);
  return printer.text;
}

}  // namespace lego_loam_sc
