// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "cli_program.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

constexpr int kScans = 40;
const std::string kRun = "$P run all -o part --checkpoint 0 --quiet";

// The scans of a drive as a stream in the file `all`, and the results of an uninterrupted run of
// them in the folder `whole`.
void prepare(const Shell& shell) {
  shell.must("$P simulate parking --sensor rs16 -o - --count " + std::to_string(kScans) + " > all");
  shell.must("$P run all -o whole --quiet");
}

// Begins a run of the stream in the folder `part` and kills it when so many of its scans are done.
void kill_after(const Shell& shell, int scans) {
  const auto bytes =
      fs::file_size(shell.folder() / "all") * static_cast<std::size_t>(scans + 1) / kScans;
  shell.must("{ head -c " + std::to_string(bytes) +
             " all; until [ -e gone ]; do sleep 0.02; done; } | "
             "$P run - -o part --checkpoint 0 --quiet & "
             "until [ -e part/scans.csv ] && [ $(wc -l < part/scans.csv) -gt " +
             std::to_string(scans) +
             " ]; do sleep 0.02; done; kill -9 $!; touch gone; wait; rm gone");
}

// scans.csv without the columns that tell times.
std::vector<std::vector<std::string>> scans_of(const fs::path& folder) {
  auto rows = read_csv(folder / "scans.csv");
  const std::vector<std::string> names = rows.at(0);
  for (auto& row : rows) {
    std::vector<std::string> kept;
    for (std::size_t c = 0; c < names.size() && c < row.size(); ++c)
      if (!names[c].ends_with("_ms") && names[c] != "delay_level") kept.push_back(row[c]);
    row = kept;
  }
  return rows;
}

void expect_same_results(const fs::path& part, const fs::path& whole) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(whole)) names.push_back(entry.path().filename());
  for (const auto& entry : fs::directory_iterator(part))
    EXPECT_TRUE(fs::exists(whole / entry.path().filename())) << entry.path();
  for (const fs::path& name : names) {
    if (name == "scans.csv" || name == "summary.json") continue;
    EXPECT_TRUE(read_text(part / name) == read_text(whole / name)) << name;
  }
  EXPECT_EQ(scans_of(part), scans_of(whole));
  auto summary = nlohmann::json::parse(read_text(part / "summary.json"));
  auto expected = nlohmann::json::parse(read_text(whole / "summary.json"));
  for (auto* json : {&summary, &expected})
    for (const char* differs : {"timing", "input"}) json->erase(differs);
  EXPECT_EQ(summary, expected);
}

void resume_to_the_same_results(const Shell& shell) {
  shell.must(kRun + " --resume");
  expect_same_results(shell.folder() / "part", shell.folder() / "whole");
}

TEST(Resume, AfterAKillEndsWithTheResultsOfAnUninterruptedRun) {
  const Shell shell;
  prepare(shell);
  for (const int scans : {0, 1, 2, 13, kScans - 2}) {
    kill_after(shell, scans);
    EXPECT_FALSE(fs::exists(shell.folder() / "part/summary.json"));
    resume_to_the_same_results(shell);
    shell.must("rm -r part");
  }
}

// At moments that nobody chose, such as that in which a checkpoint is written.
TEST(Resume, AfterManyKillsEndsWithTheSameResults) {
  const Shell shell;
  prepare(shell);
  shell.must("for wait in 0.01 0.02 0.04 0.07 0.11 0.16 0.05 0.09 0.12; do " + kRun +
             " --resume & sleep $wait; kill -9 $!; wait; done 2>/dev/null; true");
  if (fs::exists(shell.folder() / "part/checkpoint") || !fs::exists(shell.folder() / "part"))
    resume_to_the_same_results(shell);
}

TEST(Resume, WithOtherSettingsScansOrSensorIsRefused) {
  const Shell shell;
  prepare(shell);
  kill_after(shell, 5);
  const std::string table = read_text(shell.folder() / "part/scans.csv");
  const std::string resume = " -o part --checkpoint 0 --quiet --resume";
  expect_one_sentence(shell("$P run all --set loop.spacing=7" + resume), {"part", "settings"});
  shell.must("sed 's/range_noise: .*/range_noise: 0.5/' part/sensor.yaml > other.yaml");
  expect_one_sentence(shell("$P run all --sensor other.yaml" + resume), {"part", "sensor"});
  expect_one_sentence(shell("$P run all --first 3" + resume), {"part", "INPUT"});
  expect_one_sentence(shell("$P run all --count 2" + resume), {"part", "INPUT"});
  // The rows behind the checkpoint may be gone.
  EXPECT_TRUE(table.starts_with(read_text(shell.folder() / "part/scans.csv")));
  resume_to_the_same_results(shell);
}

TEST(Resume, FromADamagedCheckpointIsRefused) {
  const Shell shell;
  prepare(shell);
  kill_after(shell, 5);
  for (const char* name : {"part/checkpoint", "part/checkpoint.growth"}) {
    const fs::path file = shell.folder() / name;
    const std::string good = read_text(file);
    for (std::size_t k = 1; k < good.size(); k += 1 + k / 2) {
      std::ofstream(file, std::ios::binary) << good.substr(0, k);
      expect_one_sentence(shell(kRun + " --resume"), {name});
      std::string bad = good;
      bad[k] ^= 4;
      std::ofstream(file, std::ios::binary) << bad;
      expect_one_sentence(shell(kRun + " --resume"), {name});
    }
    std::ofstream(file, std::ios::binary) << good;
  }
  shell.must("echo gone > part/scans.csv");
  expect_one_sentence(shell(kRun + " --resume"), {"part/scans.csv"});
}

TEST(Resume, OfARunThatIsDoneIsRefusedAndOfNoneBeginsOne) {
  const Shell shell;
  prepare(shell);
  resume_to_the_same_results(shell);
  expect_one_sentence(shell(kRun + " --resume"), {"part", "no checkpoint"});
  EXPECT_EQ(shell("$P run all --resume").exit_code, 2);
}

}  // namespace
}  // namespace lego_loam_sc
