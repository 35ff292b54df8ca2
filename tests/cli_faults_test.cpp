// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "cli_program.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

const std::string kSimulate = simulate_line(6);

void expect_no_leftovers(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

nlohmann::json summary_of(const fs::path& result) {
  return nlohmann::json::parse(read_text(result / "summary.json"));
}

TEST(Faults, OfAnInputThatIsNotThereOrHoldsNoScansAreOneSentence) {
  const Shell shell;
  fs::create_directory(shell.folder() / "empty");
  expect_one_sentence(shell("$P run nowhere -o result"), {"nowhere", "does not exist"});
  expect_one_sentence(shell("$P run empty -o result"), {"empty", "no scans"});
  EXPECT_FALSE(fs::exists(shell.folder() / "result"));
}

TEST(Faults, OfSettingsNameTheSettingAndWhatIsValid) {
  const Shell shell;
  shell.must(kSimulate);
  shell.files().write("bad.yaml", "mapping:\n  voxel_size: 0.4\n  radios: 50\n");
  expect_one_sentence(shell("$P run scans -o result --set loop.treshold=1"),
                      {"loop.treshold", "loop.scan_context.threshold"});
  expect_one_sentence(shell("$P run scans -o result --set mapping.levels=99"),
                      {"mapping.levels", "99", "between 1 and 4"});
  expect_one_sentence(shell("$P run scans -o result --config bad.yaml"),
                      {"bad.yaml, line 3", "mapping.radios", "mapping.radius"});
  expect_one_sentence(shell("$P run scans -o result --method lego-loam-cs"),
                      {"lego-loam-cs", "lego-loam-sc"});
  EXPECT_FALSE(fs::exists(shell.folder() / "result"));
}

TEST(Faults, OfTheSensorNameThePresetsOrTheMismatch) {
  const Shell shell;
  shell.must(kSimulate);
  expect_one_sentence(shell("$P run scans -o result --quiet --sensor vlp61"), {"vlp61", "vlp16"});
  expect_one_sentence(shell("$P run scans -o result --quiet --sensor hdl64e"),
                      {"does not fit the sensor hdl64e", "--sensor"});
  shell.must("echo 'sensor: hdl64e' > scans/dataset.yaml");
  expect_one_sentence(shell("$P run scans -o result --quiet"), {"does not fit the sensor hdl64e"});
  EXPECT_FALSE(fs::exists(shell.folder() / "result"));
}

TEST(Faults, OfAWorldNameTheWorlds) {
  const Shell shell;
  expect_one_sentence(shell("$P simulate garage -o scans"), {"garage", "parking", "street"});
  EXPECT_FALSE(fs::exists(shell.folder() / "scans"));
}

TEST(Faults, NeverOverwriteResultsOrScans) {
  const Shell shell;
  shell.must(kSimulate);
  shell.files().write("taken/notes.txt", "mine");
  expect_one_sentence(shell("$P run scans --quiet -o taken"), {"taken", "never overwrites"});
  expect_one_sentence(shell("$P simulate parking --count 1 -o taken"), {"taken", "is not empty"});
  EXPECT_EQ(read_text(shell.folder() / "taken/notes.txt"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(shell.folder() / "taken"), {}), 1);
}

TEST(Faults, OfOneScanLeaveTheOthers) {
  const Shell shell;
  shell.must(kSimulate);
  fs::resize_file(shell.folder() / "scans/velodyne/000002.bin", 1001);
  expect_one_sentence(shell("$P run scans -o result --quiet"), {"000002.bin", "1001 bytes"});
  EXPECT_EQ(lines_of(shell.folder() / "result/trajectory.tum").size(), 5U);
  const auto summary = summary_of(shell.folder() / "result");
  EXPECT_EQ(summary["scans"], 5);
  ASSERT_EQ(summary["faults"].size(), 1U);
  EXPECT_NE(summary["faults"][0].get<std::string>().find("000002.bin"), std::string::npos);
  expect_no_leftovers(shell.folder());
}

TEST(Faults, OfAPointFileNameTheFileAndTheField) {
  const Shell shell;
  const std::string header =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
      "POINTS 2\nDATA binary\n";
  shell.files().write("pcd/0.pcd", header + std::string(24, '\0'));
  shell.files().write("pcd/1.pcd", header + std::string(12, '\0'));
  shell.files().write("ply/0.ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                      "y\nproperty float z\nend_header\n9 1 0\n");
  shell.files().write("ply/1.ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float y\nproperty float "
                      "z\nend_header\n1 0\n");
  expect_one_sentence(shell("$P run pcd -o a --quiet --sensor vlp16"),
                      {"1.pcd", "2 points of 12 bytes"});
  expect_one_sentence(shell("$P run ply -o b --quiet --sensor vlp16"), {"1.ply", "no field x"});
  EXPECT_EQ(summary_of(shell.folder() / "a")["scans"], 1);
  EXPECT_EQ(summary_of(shell.folder() / "b")["status"]["too_few_points"], 1);
}

TEST(Faults, OfAStreamThatIsCutLeaveWhatWasWhole) {
  const Shell shell;
  shell.must("$P simulate parking --count 6 --sensor rs16 -o - > whole");
  fs::resize_file(shell.folder() / "whole", fs::file_size(shell.folder() / "whole") - 1000);
  expect_one_sentence(shell("$P run - -o result --quiet < whole"),
                      {"standard input", "truncated", "5 scans were complete"});
  EXPECT_EQ(lines_of(shell.folder() / "result/trajectory.tum").size(), 5U);
  expect_one_sentence(shell("head -c 10 whole | $P run - -o none --quiet"), {"truncated"});
  EXPECT_FALSE(fs::exists(shell.folder() / "none"));
}

TEST(Faults, OfTheTruthAreFoundBeforeTheRunOrCostNoResults) {
  const Shell shell;
  shell.must(kSimulate);
  expect_one_sentence(shell("$P run scans -o early --quiet --truth scans/calib.txt"),
                      {"calib.txt, line 1"});
  EXPECT_FALSE(fs::exists(shell.folder() / "early"));
  shell.files().write("other.tum", "900 0 0 0 0 0 0 1\n901 0 0 0 0 0 0 1\n");
  expect_one_sentence(shell("$P run scans -o late --quiet --truth other.tum"),
                      {"other.tum", "in common"});
  EXPECT_EQ(summary_of(shell.folder() / "late")["scans"], 6);
}

TEST(Faults, OfUsageExitWithTwoAndSayWhereHelpIs) {
  const Shell shell;
  for (const char* line : {"$P", "$P run", "$P run a b", "$P run a --bogus", "$P run a --threads 0",
                           "$P run a --count -1", "$P run a --truth nowhere", "$P simulate parking",
                           "$P simulate parking -o - --distort perhaps", "$P match a",
                           "$P evaluate a", "$P no-such-verb"}) {
    const Outcome outcome = shell(line);
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_EQ(outcome.out, "") << line;
    EXPECT_NE(outcome.err.find("--help"), outcome.err.npos) << line << "\n" << outcome.err;
  }
  EXPECT_NE(shell("$P no-such-verb").err.find("no-such-verb"), std::string::npos);
}

}  // namespace
}  // namespace lego_loam_sc
