// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "cli_program.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

// The folder of results is in trouble: one sentence, exit code 1, and what is there is whole.

const std::string kSimulate = simulate_line(6);

void expect_whole_tables(const fs::path& result) {
  const auto rows = read_csv(result / "scans.csv");
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  for (const char* name : {"scans.csv", "loops.csv", "odometry.tum"}) {
    const std::string text = read_text(result / name);
    EXPECT_TRUE(text.empty() || text.ends_with('\n')) << name;
  }
  for (const auto& entry : fs::directory_iterator(result))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

// A line of shell in a namespace where folders can be mounted.
std::string with_mounts(const std::string& line) {
  return std::string(geteuid() == 0 ? "unshare -m" : "unshare -rm") + " sh -c '" + line + "'";
}
#define NEED_MOUNTS(shell)                                                     \
  if ((shell)(with_mounts("mkdir m && mount -t tmpfs none m")).exit_code != 0) \
  GTEST_SKIP() << "needs root or user namespaces to mount a small disk"

TEST(Disk, ThatIsFullForTheMapHasTakenTheRest) {
  const Shell shell;
  shell.must(kSimulate);
  // 48 KiB for each file, which the tables fit into and the map does not.
  expect_one_sentence(shell("ulimit -f 48; $P run scans -o result --quiet"),
                      {"result/map.ply cannot be written"});
  const fs::path result = shell.folder() / "result";
  expect_whole_tables(result);
  EXPECT_EQ(lines_of(result / "trajectory.tum").size(), 6U);
  EXPECT_TRUE(fs::exists(result / "summary.json"));
  EXPECT_FALSE(fs::exists(result / "map.ply"));
  EXPECT_FALSE(fs::exists(result / "map.pcd"));
}

TEST(Disk, ThatIsFullFromTheBeginningLeavesNothingThatLooksWhole) {
  const Shell shell;
  shell.must(kSimulate);
  // 1 KiB: the settings do not fit.
  expect_one_sentence(shell("ulimit -f 1; $P run scans -o a --quiet"), {"a/settings.yaml"});
  for (const auto& entry : fs::directory_iterator(shell.folder() / "a"))
    EXPECT_EQ(entry.file_size(), 0U) << entry.path();
}

TEST(Disk, ThatIsFullAnywhereIsSaidAndLeavesWholeLines) {
  const Shell shell;
  shell.must(kSimulate);
  NEED_MOUNTS(shell);
  for (const char* size : {"16k", "24k", "32k", "64k", "120k"}) {
    const std::string result = std::string("r") + size;
    const Outcome outcome =
        shell("P=$P " +
              with_mounts("mkdir disk " + result + " 2>/dev/null; mount -t tmpfs -o size=" + size +
                          " none disk && $P run scans -o disk/out --quiet; " +
                          "code=$?; cp -r disk/out/. " + result + "; exit $code"));
    expect_one_sentence(outcome, {"disk/out", "No space left on device"});
    if (fs::exists(shell.folder() / result / "scans.csv"))
      expect_whole_tables(shell.folder() / result);
  }
}

TEST(Disk, ThatIsReadOnlyIsSaid) {
  const Shell shell;
  shell.must(kSimulate);
  NEED_MOUNTS(shell);
  const std::string mount = "mkdir -p disk; mount -t tmpfs -o ro none disk && ";
  expect_one_sentence(shell("P=$P " + with_mounts(mount + "$P run scans -o disk/out --quiet")),
                      {"disk/out: cannot be made (Read-only file system)", "-o"});
  expect_one_sentence(shell("P=$P " + with_mounts(mount + "$P run scans -o disk --quiet")),
                      {"disk/", "Read-only file system"});
}

TEST(Disk, FolderBelowAFileIsSaid) {
  const Shell shell;
  shell.must(kSimulate);
  shell.files().write("file", "mine");
  expect_one_sentence(shell("$P run scans -o file/out --quiet"), {"file/out", "-o"});
  EXPECT_EQ(read_text(shell.folder() / "file"), "mine");
}

TEST(Disk, FolderRemovedDuringTheRunIsSaid) {
  const Shell shell;
  shell.must("$P simulate parking --count 6 --sensor rs16 -o - > all");
  const std::string half = std::to_string(fs::file_size(shell.folder() / "all") / 2);
  expect_one_sentence(shell("{ head -c " + half +
                            " all; until [ -s result/scans.csv ]; do sleep 0.05; done; "
                            "rm -r result; tail -c +$((" +
                            half + " + 1)) all; } | $P run - -o result --quiet"),
                      {"result/scans.csv: was removed while it was written"});
  EXPECT_FALSE(fs::exists(shell.folder() / "result"));
}

}  // namespace
}  // namespace lego_loam_sc
