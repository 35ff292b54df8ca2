// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "cli_program.hpp"
#include "core/status.hpp"
#include "core/text.hpp"
#include "io/settings_yaml.hpp"
#include "loop/loop_verifier.hpp"
#include "slam/settings.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = LEGO_LOAM_SC_SOURCE;

std::string stripped(const std::string& text) {
  const auto begin = text.find_first_not_of(" `");
  const auto end = text.find_last_not_of(" `");
  return begin == text.npos ? "" : text.substr(begin, end - begin + 1);
}

// The rows of all tables under the heading `## heading` of a document, cell by cell.
std::vector<std::vector<std::string>> table_rows(const fs::path& document,
                                                 const std::string& heading) {
  std::vector<std::vector<std::string>> rows;
  std::string section;
  int rows_of_table = 0;
  for (const std::string& line : lines_of(document)) {
    if (line.starts_with("## ")) section = stripped(line.substr(3));
    rows_of_table = line.starts_with("|") ? rows_of_table + 1 : 0;
    // The first two lines of a table are its head.
    if (rows_of_table < 3 || (!heading.empty() && section != heading)) continue;
    std::vector<std::string> cells;
    for (const std::string& cell : split(line.substr(1), '|')) cells.push_back(stripped(cell));
    rows.push_back(cells);
  }
  return rows;
}

std::vector<std::string> first_cells(const std::string& document, const std::string& heading) {
  std::vector<std::string> names;
  for (const auto& row : table_rows(kSource / document, heading)) names.push_back(row.front());
  return names;
}

// name, default and range of every setting, as docs/settings.md must show them.
std::map<std::string, std::string> expected_settings() {
  std::map<std::string, std::string> expected;
  const Settings settings = load_settings("lego-loam-sc", {}, {});
  Settings::groups(settings, [&](const std::string& group, const auto& section) {
    visit_settings(section, [&](const std::string& name, auto value, auto... facts) {
      std::string& row = expected[group + "." + name];
      if constexpr (sizeof...(facts) == 3) {
        const auto [minimum, maximum, comment] = std::tuple(facts...);
        row = to_text(value) + ", " + to_text(minimum) + " to " + to_text(maximum);
      } else {
        row = value ? "true, true or false" : "false, true or false";
      }
    });
  });
  return expected;
}

TEST(Documents, ListEverySettingWithItsDefaultAndRange) {
  std::map<std::string, std::string> documented;
  for (const auto& row : table_rows(kSource / "docs/settings.md", "")) {
    if (row.front().find('.') == std::string::npos) continue;  // a table of methods
    ASSERT_EQ(row.size(), 4U) << row.front();
    EXPECT_FALSE(row[3].empty()) << row.front();
    documented[row[0]] = row[1] + ", " + row[2];
  }
  EXPECT_EQ(documented, expected_settings());
}

TEST(Documents, ListTheColumnsOfTheTablesThatARunWrites) {
  const Shell shell;
  shell.must("$P simulate parking --count 2 --sensor rs16 -o scans && $P run scans -o result");
  for (const char* name : {"scans.csv", "loops.csv"})
    EXPECT_EQ(first_cells("docs/output.md", name), read_csv(shell.folder() / "result" / name)[0]);
}

TEST(Documents, ListTheFilesThatARunLeaves) {
  const Shell shell;
  shell.must("$P simulate parking --count 2 --sensor rs16 -o scans && $P run scans -o result");
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(shell.folder() / "result"))
    files.insert(entry.path().filename().string());
  const auto documented = first_cells("docs/output.md", "Files");
  EXPECT_EQ(std::set<std::string>(documented.begin(), documented.end()), files);
}

// Names of all leaves; `status`, the health and the errors have tables of their own.
void add_leaves(const nlohmann::ordered_json& object, const std::string& prefix,
                std::vector<std::string>& names) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix + key;
    const bool leaf = !value.is_object() || name == "status" || name == "health" ||
                      name == "timing.delay" || name == "errors.trajectory" ||
                      name == "errors.odometry";
    if (leaf)
      names.push_back(name);
    else
      add_leaves(value, name + ".", names);
  }
}

TEST(Documents, ListTheFieldsOfTheSummaryAndOfTheErrors) {
  const Shell shell;
  shell.must("$P simulate parking --count 30 --sensor rs16 -o scans");
  shell.must("$P run scans -o result --truth scans/truth.tum");
  const auto summary =
      nlohmann::ordered_json::parse(read_text(shell.folder() / "result/summary.json"));
  std::vector<std::string> names;
  add_leaves(summary, "", names);
  EXPECT_EQ(first_cells("docs/output.md", "summary.json"), names);

  names.clear();
  for (const auto& [key, value] : summary["health"].items()) names.push_back(key);
  names.push_back("delay");
  EXPECT_EQ(first_cells("docs/output.md", "Health"), names);

  names.clear();
  for (const auto& [key, value] : summary["errors"]["trajectory"].items()) names.push_back(key);
  EXPECT_EQ(first_cells("docs/output.md", "Errors against truth"), names);
}

// The names of an enumeration whose values go from 0 on.
template <class Enumeration>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  for (int k = 0; names.empty() || names.back() != "unknown"; ++k)
    names.emplace_back(to_string(static_cast<Enumeration>(k)));
  names.pop_back();
  return names;
}

TEST(Documents, ListEveryStatusOfAScanAndEveryVerdictOnALoop) {
  const auto sorted = [](std::vector<std::string> names) {
    std::ranges::sort(names);
    return names;
  };
  EXPECT_EQ(sorted(first_cells("docs/output.md", "Status of a scan")), sorted(names_of<Status>()));
  EXPECT_EQ(sorted(first_cells("docs/output.md", "Verdict on a loop")),
            sorted(names_of<Verdict>()));
}

// All text of the files in a folder whose names end in `ending`.
std::string text_of_files(const fs::path& folder, const std::string& ending) {
  std::string text;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().string().ends_with(ending)) text += read_text(entry.path());
  return text;
}

TEST(Documents, NameTestsThatExist) {
  const std::string tests = text_of_files(kSource / "tests", "_test.cpp") +
                            text_of_files(kSource / "sim/tests", "_test.cpp");
  const std::string python = text_of_files(kSource / "python/tests", ".py");
  const std::string document = read_text(kSource / "docs/reliability.md");
  const std::regex name("`(?:([A-Z]\\w+)\\.([A-Z]\\w+)|(test_\\w+))`");
  int found = 0;
  for (std::sregex_iterator match(document.begin(), document.end(), name), end; match != end;
       ++match, ++found) {
    const std::string suite = (*match)[1], test = (*match)[2], function = (*match)[3];
    const bool exists = function.empty() ? tests.find("(" + suite + ", " + test + ")") != tests.npos
                                         : python.find("def " + function + "(") != python.npos;
    EXPECT_TRUE(exists) << match->str();
  }
  EXPECT_GT(found, 30);
}

}  // namespace
}  // namespace lego_loam_sc
