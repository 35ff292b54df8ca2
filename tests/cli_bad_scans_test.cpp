// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli_program.hpp"
#include "io/bytes.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

std::string points(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) append(bytes, value);
  return bytes;
}

std::string repeated(const std::string& point, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += point;
  return bytes;
}

TEST(BadScans, GetAStatusAndTheRunGoesOn) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Shell shell;
  shell.must("$P simulate parking --count 14 --sensor rs16 -o scans");
  const std::vector<std::string> bad = {
      "",
      points({5, 1, 0, 1}),
      repeated(points({nan, nan, nan, nan}), 3000),
      repeated(points({5, 1, 0, 1}), 3000),
      repeated(points({1e30F, 1e30F, -1e30F, 1}), 3000),
      repeated(points({0, 0, 0, 0}), 3000),
  };
  for (std::size_t k = 0; k < bad.size(); ++k)
    shell.files().write(
        "scans/velodyne/0000" + std::string(k < 2 ? "0" : "") + std::to_string(8 + k) + ".bin",
        bad[k]);
  shell.must("$P run scans -o result --quiet");
  const auto rows = read_csv(shell.folder() / "result/scans.csv");
  ASSERT_EQ(rows.size(), 15U);
  for (std::size_t k = 0; k < 14; ++k) {
    const std::string& status = rows[k + 1][2];
    EXPECT_TRUE(k < 8 ? status == "ok" : status == "too_few_points" || status == "lost")
        << "scan " << k << ": " << status;
  }
  EXPECT_EQ(lines_of(shell.folder() / "result/trajectory.tum").size(), 14U);
}

TEST(BadStamps, AreCountedAndSaidOnce) {
  const Shell shell;
  shell.must("$P simulate parking --count 10 --sensor rs16 -o scans");
  std::string times;
  for (const char* time :
       {"0", "0.1", "0.2", "3600.3", "3600.4", "3600.4", "3600.6", "0.7", "0.8", "0.9"})
    times += std::string(time) + "\n";
  shell.files().write("scans/times.txt", times);
  const std::string out = shell.must("$P run scans -o result");
  const auto summary = nlohmann::json::parse(read_text(shell.folder() / "result/summary.json"));
  EXPECT_EQ(summary["stamp_jumps"], 2);
  EXPECT_EQ(summary["status"]["out_of_order"], 1);
  EXPECT_NE(out.find("time stamp jumps bridged: 2, first at scan 3 by 3600.1 s\n"), out.npos)
      << out;
  EXPECT_NE(out.find("1 scans out_of_order\n"), out.npos) << out;
  EXPECT_EQ(lines_of(shell.folder() / "result/trajectory.tum").size(), 9U);
}

TEST(HostileFiles, EndInOneSentenceAndLittleMemory) {
  const Shell shell;
  const std::string header = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  shell.files().write("a/0.pcd",
                      header + "WIDTH 4000000000\nHEIGHT 4000000000\nDATA ascii\n1 2 3\n");
  std::string packed = header + "WIDTH 300000000\nHEIGHT 1\nDATA binary_compressed\n";
  append(packed, std::uint32_t{4});
  append(packed, std::uint32_t{3'600'000'000U});
  shell.files().write("b/0.pcd", packed + "abcd");
  shell.files().write(
      "c/0.ply",
      "ply\nformat ascii 1.0\nelement vertex 9000000000000000000\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n1 2 3\n");
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "{a: ";
  shell.files().write("deep.yaml", deep);
  shell.files().write("list.yaml", "mapping: " + std::string(100'000, '['));
  shell.files().write("d/0.bin", points({5, 1, 0, 1}));
  shell.files().write("d/dataset.yaml", "sensor: /dev/zero\n");
  fs::create_symlink("/dev/zero", shell.folder() / "d/9.bin");
  fs::create_symlink("loop.bin", shell.folder() / "d/loop.bin");
  // An address space of 1.5 GB: what a header promises does not fit. A sanitizer alone needs more.
#ifdef LEGO_LOAM_SC_SANITIZED
  const std::string limit;
#else
  const std::string limit = "ulimit -v 1500000; ";
#endif
  for (const char* input : {"a", "b", "c", "a --config deep.yaml", "a --config list.yaml",
                            "a --config /dev/zero", "d"}) {
    const Outcome outcome = shell(limit + "$P run " + input + " -o result --quiet");
    EXPECT_EQ(outcome.exit_code, 1) << input;
    EXPECT_TRUE(outcome.err.starts_with("lego-loam-sc: ")) << outcome.err;
    EXPECT_EQ(outcome.err.find("internal error"), outcome.err.npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("not enough memory"), outcome.err.npos) << outcome.err;
    EXPECT_LE(outcome.err.size(), 500U) << outcome.err;
  }
}

}  // namespace
}  // namespace lego_loam_sc
