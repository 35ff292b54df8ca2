// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "io_test_files.hpp"

namespace lego_loam_sc {

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

inline std::vector<std::string> lines_of(const std::filesystem::path& path) {
  return split(read_text(path), '\n');
}

inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

/// What a command did.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// The program on the command line of a shell, in a folder of the test's own.
class Shell {
 public:
  const std::filesystem::path& folder() const { return files_.path(); }
  const TemporaryFolder& files() const { return files_; }

  /// Runs a line of shell; `$P` in it is the program.
  Outcome operator()(const std::string& line) const {
    const std::string log = "../" + folder().filename().string();
    std::string shell = "cd '" + folder().string() + "' && P='" LEGO_LOAM_SC_PROGRAM "' && ";
    const int status =
        std::system((shell + "{ " + line + "\n} >" + log + ".out 2>" + log + ".err").c_str());
    const Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                          read_text(folder().string() + ".out"),
                          read_text(folder().string() + ".err")};
    std::filesystem::remove(folder().string() + ".out");
    std::filesystem::remove(folder().string() + ".err");
    return outcome;
  }

  /// The same for a line that must succeed.
  std::string must(const std::string& line) const {
    const Outcome outcome = (*this)(line);
    EXPECT_EQ(outcome.exit_code, 0) << line << "\n" << outcome.err;
    return outcome.out;
  }

 private:
  TemporaryFolder files_;
};

/// That the command failed with one line on standard error, which holds all of `words`, and nothing
/// else.
inline void expect_one_sentence(const Outcome& outcome,
                                std::initializer_list<std::string_view> words) {
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(split(outcome.err, '\n').size(), 1U) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("lego-loam-sc: ")) << outcome.err;
  for (const std::string_view word : words)
    EXPECT_NE(outcome.err.find(word), outcome.err.npos) << word << " in " << outcome.err;
}

/// The line that makes `count` scans of a drive through a car park in the folder `scans`.
inline std::string simulate_line(int count) {
  return "$P simulate parking --count " + std::to_string(count) + " --sensor rs16 -o scans";
}

/// Rows of a CSV file, the header first.
inline std::vector<std::vector<std::string>> read_csv(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : lines_of(path)) rows.push_back(split(line, ','));
  return rows;
}

}  // namespace lego_loam_sc
