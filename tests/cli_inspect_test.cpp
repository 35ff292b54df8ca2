// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "cli_program.hpp"
#include "io/bytes.hpp"
#include "io/ply.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

const std::string kSimulate = simulate_line(3);

// The lines that inspect prints, by their first word.
std::map<std::string, std::string> facts_of(const std::string& text) {
  std::map<std::string, std::string> facts;
  for (const std::string& line : split(text, '\n'))
    if (line.size() > 10) facts[line.substr(0, line.find(' '))] = line.substr(10);
  return facts;
}

// How many points of a cloud have which colour; a point ends with its colour.
std::map<std::array<std::uint8_t, 3>, int> colours_in(const fs::path& ply) {
  const std::string bytes = read_text(ply);
  const std::size_t count = read_ply(ply).scan.size();
  const std::size_t begin = bytes.find("end_header\n") + 11;
  const std::size_t size = (bytes.size() - begin) / count;
  EXPECT_EQ(begin + size * count, bytes.size());
  std::map<std::array<std::uint8_t, 3>, int> colours;
  for (std::size_t i = 1; i <= count; ++i)
    ++colours[load<std::array<std::uint8_t, 3>>(&bytes[begin + i * size - 3])];
  return colours;
}

TEST(Inspect, LeavesTheDocumentedFiles) {
  const Shell shell;
  shell.must(kSimulate);
  shell.must("$P inspect scans/velodyne/000002.bin --sensor rs16 -o result");
  std::set<std::string> names = names_in(shell.folder() / "result");
  names.erase("report.html");  // is there where the companion package is
  EXPECT_EQ(names,
            (std::set<std::string>{"stages.json", "rows.ply", "segments.ply", "roughness.ply",
                                   "features_large.ply", "features_small.ply"}));
}

TEST(Inspect, PrintsTheCountsThatARunFinds) {
  const Shell shell;
  shell.must(kSimulate);
  auto facts = facts_of(shell.must("$P inspect scans --first 2"));
  shell.must("$P run scans --first 2 --count 1 -o run");
  const auto rows = read_csv(shell.folder() / "run/scans.csv");
  std::map<std::string, std::string> scan;
  for (std::size_t k = 0; k < rows[0].size(); ++k) scan[rows[0][k]] = rows[1][k];
  EXPECT_EQ(facts["features"], scan["edges_large"] + " edges, " + scan["edges_sharp"] +
                                   " of them sharp; " + scan["planars_large"] + " planar points, " +
                                   scan["planars_flat"] + " of them flat");
  EXPECT_TRUE(facts["clusters"].starts_with(scan["clusters"] + " with "));
  EXPECT_TRUE(facts["scan"].starts_with(scan["points"] + " points"));
  EXPECT_TRUE(facts["rows"].starts_with("16 of 16 have points"));
  EXPECT_EQ(facts["sensor"], "rs16, 16 rows from -15.0 to 15.0 deg");
}

TEST(Inspect, LevelsATiltedSensorAsARunDoes) {
  const Shell shell;
  shell.must(kSimulate);
  shell.must(
      "$P run scans --count 1 -o run && "
      "sed 's/^mount_pitch_deg: .*/mount_pitch_deg: 15/' run/sensor.yaml >tilted.yaml && "
      "$P simulate parking --count 1 --sensor tilted.yaml -o tilted");
  auto told = facts_of(shell.must("$P inspect tilted --sensor tilted.yaml"));
  EXPECT_EQ(told["tilt"], "roll 0.0, pitch 15.0 deg, from the sensor's file");
  auto found = facts_of(shell.must("$P inspect tilted --sensor rs16"));
  EXPECT_TRUE(found["tilt"].ends_with(" deg, estimated")) << found["tilt"];
  EXPECT_NEAR(std::stod(found["tilt"].substr(found["tilt"].find("pitch ") + 6)), 15.0, 1.0);
  EXPECT_NEAR(std::stod(found["ground"]), std::stod(told["ground"]), 3.0);
  auto level = facts_of(shell.must("$P inspect scans"));
  EXPECT_FALSE(level.contains("tilt"));
}

TEST(Inspect, ColoursEachStageByWhatItPrints) {
  const Shell shell;
  shell.must(kSimulate);
  shell.must("$P run scans --count 1 -o run && $P inspect scans -o result");
  const auto rows = read_csv(shell.folder() / "run/scans.csv");
  const auto number = [&](const char* column) {
    return std::stoi(rows[1][std::ranges::find(rows[0], column) - rows[0].begin()]);
  };
  const fs::path result = shell.folder() / "result";
  EXPECT_EQ(read_ply(result / "rows.ply").scan.size(), number("points"));
  EXPECT_EQ(colours_in(result / "rows.ply").size(), 8U);
  auto segments = colours_in(result / "segments.ply");
  EXPECT_EQ((segments[{224, 32, 32}]), number("ground_points"));
  EXPECT_EQ((segments[{170, 170, 170}]),
            number("points") - number("ground_points") - number("segment_points"));
  auto large = colours_in(result / "features_large.ply");
  EXPECT_EQ((large[{0, 64, 255}]), number("edges_large"));
  EXPECT_EQ((large[{255, 140, 0}]), number("planars_large"));
  auto small = colours_in(result / "features_small.ply");
  EXPECT_EQ((small[{0, 160, 0}]), number("edges_sharp"));
  EXPECT_EQ((small[{255, 20, 147}]), number("planars_flat"));
}

TEST(Inspect, LeavesThePageWhatTheCloudsDoNotSay) {
  const Shell shell;
  shell.must(kSimulate);
  const std::string out = shell.must("$P inspect scans -o result");
  const auto facts = nlohmann::json::parse(read_text(shell.folder() / "result/stages.json"));
  EXPECT_EQ(facts["input"], "scans");
  EXPECT_EQ(facts["rows"], 16);
  EXPECT_EQ(facts["columns"], 1800);
  EXPECT_EQ(facts["elevation_deg"].size(), 16U);
  EXPECT_TRUE(out.starts_with(facts["summary"].get<std::string>()));
}

TEST(Inspect, ShowsAScanThatDoesNotFitTheSensorAndSaysSo) {
  const Shell shell;
  shell.must("$P simulate parking --count 1 --sensor hdl32e -o scans");
  const Outcome outcome = shell("$P inspect scans --sensor vlp16 -o result");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("the scan does not fit the sensor vlp16"), outcome.err.npos);
  EXPECT_TRUE(fs::exists(shell.folder() / "result/rows.ply"));
}

TEST(Inspect, SaysWhatIsInAScanWhoseSensorIsNotRecognised) {
  const Shell shell;
  std::string cloud =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n"
      "HEIGHT 1\nPOINTS 2\nDATA ascii\n1 0 0\n0 2 2\n";
  shell.files().write("scan.pcd", cloud);
  const Outcome outcome = shell("$P inspect scan.pcd -o result");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("the sensor is not recognised"), outcome.err.npos);
  auto facts = facts_of(outcome.out);
  EXPECT_EQ(facts["scan"], "2 points, 2 with a return at 1.0 to 2.8 m, 0.0 to 45.0 deg");
  EXPECT_EQ(facts["fields"], "no intensity, no rings, no times");
  EXPECT_FALSE(fs::exists(shell.folder() / "result"));
}

TEST(Inspect, OverwritesNothingAndNamesAScanThatIsNotThere) {
  const Shell shell;
  shell.must(kSimulate);
  EXPECT_EQ(shell("$P inspect scans -o scans").exit_code, 1);
  const Outcome missing = shell("$P inspect scans --first 3");
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("there is no scan 3"), missing.err.npos);
}

}  // namespace
}  // namespace lego_loam_sc
