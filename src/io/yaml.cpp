// SPDX-License-Identifier: BSD-3-Clause
#include "io/yaml.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "core/text.hpp"

namespace lego_loam_sc {
namespace {

// Flattens the events of the parser. Unlike nodes, events show duplicate keys, and aliases cannot
// expand a small file into a huge one.
class Flattener : public YAML::EventHandler {
 public:
  explicit Flattener(const std::string& file) : file_(file) {}

  std::vector<YamlEntry> take_entries() { return std::move(entries_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(mark, "a second document starts here; only one is allowed");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
    if (groups_.empty()) return;  // only comments
    fail(mark, "a value is missing; give one or remove the line");
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    fail(mark, "aliases are not allowed; write the value out");
  }

  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string& value) override {
    if (in_list_) {
      entries_.back().values.push_back(value);
    } else if (groups_.empty()) {
      fail(mark, "lines of \"key: value\" are expected");
    } else if (groups_.back().key.empty()) {
      if (value.empty()) fail(mark, "a key is empty");
      groups_.back().key = value;
      groups_.back().line = mark.line + 1;
    } else {
      begin_entry(false).values.push_back(value);
    }
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    if (in_list_ || groups_.empty() || groups_.back().key.empty())
      fail(mark, "a list is not expected here");
    begin_entry(true);
    in_list_ = true;
  }
  void OnSequenceEnd() override { in_list_ = false; }

  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    if (in_list_ || (!groups_.empty() && groups_.back().key.empty()))
      fail(mark, "a map is not expected here");
    if (groups_.size() > kMaxDepth) fail(mark, "groups are nested too deeply");
    std::string prefix;
    if (!groups_.empty()) prefix = groups_.back().prefix + groups_.back().key + ".";
    groups_.push_back({prefix, {}, 0});
  }
  void OnMapEnd() override {
    groups_.pop_back();
    if (!groups_.empty()) groups_.back().key.clear();
  }

 private:
  static constexpr std::size_t kMaxDepth = 8;

  struct Group {
    std::string prefix;
    std::string key;  // its value comes next; empty before a key
    int line;
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    throw InputError(file_ + ", line " + std::to_string(mark.line + 1) + ": " + what);
  }

  YamlEntry& begin_entry(bool is_list) {
    Group& group = groups_.back();
    YamlEntry entry{
        group.prefix + group.key, {}, is_list, file_ + ", line " + std::to_string(group.line)};
    if (!seen_.insert(entry.key).second)
      throw InputError(entry.where + ": " + entry.key + " occurs twice");
    group.key.clear();
    return entries_.emplace_back(std::move(entry));
  }

  const std::string& file_;
  std::vector<YamlEntry> entries_;
  std::set<std::string> seen_;
  std::vector<Group> groups_;
  bool in_list_ = false;
  int documents_ = 0;
};

[[noreturn]] void fail_value(const YamlEntry& entry, const std::string& allowed) {
  throw InputError(entry.where + ": " + entry.key + " is " +
                   (entry.is_list ? "[" + join(entry.values) + "]" : entry.values.front()) +
                   ", it must be " + allowed);
}

}  // namespace

std::vector<YamlEntry> parse_yaml(const std::string& text, const std::string& file) {
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    Flattener flattener(file);
    while (parser.HandleNextDocument(flattener)) {
    }
    return flattener.take_entries();
  } catch (const YAML::Exception& error) {
    throw InputError(file + ", line " + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
}

bool to_bool(const YamlEntry& entry) {
  if (!entry.is_list && entry.values.front() == "true") return true;
  if (!entry.is_list && entry.values.front() == "false") return false;
  fail_value(entry, "true or false");
}

int to_int(const YamlEntry& entry, int minimum, int maximum) {
  const auto value = entry.is_list ? std::nullopt : parse_integer<int>(entry.values.front());
  if (!value || *value < minimum || *value > maximum)
    fail_value(entry, "an integer between " + to_text(minimum) + " and " + to_text(maximum));
  return *value;
}

double to_double(const YamlEntry& entry, double minimum, double maximum) {
  const auto value = entry.is_list ? std::nullopt : parse_double(entry.values.front());
  if (!value || !(*value >= minimum && *value <= maximum))
    fail_value(entry, "a number between " + to_text(minimum) + " and " + to_text(maximum));
  return *value;
}

double to_double(const YamlEntry& entry) {
  const auto value = entry.is_list ? std::nullopt : parse_double(entry.values.front());
  if (!value || !std::isfinite(*value)) fail_value(entry, "a number");
  return *value;
}

const std::string& to_string(const YamlEntry& entry) {
  if (entry.is_list) fail_value(entry, "a single word");
  return entry.values.front();
}

std::vector<double> to_doubles(const YamlEntry& entry) {
  std::vector<double> numbers;
  for (const std::string& text : entry.values) {
    const auto value = parse_double(text);
    if (!entry.is_list || !value || !std::isfinite(*value)) fail_value(entry, "a list of numbers");
    numbers.push_back(*value);
  }
  return numbers;
}

void fail_unknown_key(const YamlEntry& entry, std::span<const std::string> keys) {
  throw InputError(entry.where + ": there is no " + entry.key + "; the nearest is " +
                   nearest_name(entry.key, keys));
}

}  // namespace lego_loam_sc
