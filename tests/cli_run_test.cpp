// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "cli_program.hpp"
#include "core/text.hpp"
#include "eval/association.hpp"
#include "eval/errors.hpp"
#include "io/bytes.hpp"
#include "io/pcd.hpp"
#include "io/ply.hpp"
#include "io/trajectory.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

const std::string kSimulate = simulate_line(12);
// Far enough for several key frames; visits of the same aisle count as loops.
const std::string kLongSimulate = simulate_line(60);
const std::string kLoopyRun = "$P run scans --set loop.min_travel=2 --set loop.spacing=0.5";

// The columns of scans.csv that are the same in every run, and summary.json without its times.
std::string without_times(const fs::path& file) {
  if (file.filename() == "scans.csv") {
    std::string kept;
    const auto rows = read_csv(file);
    for (const auto& row : rows)
      for (std::size_t i = 0; i < row.size(); ++i)
        if (!rows.front()[i].ends_with("_ms") && rows.front()[i] != "delay_level")
          kept += row[i] + ",";
    return kept;
  }
  if (file.filename() == "summary.json") {
    auto summary = nlohmann::json::parse(read_text(file));
    EXPECT_EQ(summary.erase("timing"), 1U);
    return summary.dump();
  }
  return read_text(file);
}

void expect_same_files(const fs::path& a, const fs::path& b) {
  ASSERT_EQ(names_in(a), names_in(b));
  for (const std::string& name : names_in(a))
    EXPECT_TRUE(without_times(a / name) == without_times(b / name)) << name;
}

double largest_difference(const Trajectory& a, const Trajectory& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, (a[i].pose.matrix() - b[i].pose.matrix()).cwiseAbs().maxCoeff());
  return largest;
}

TEST(Run, LeavesExactlyTheDocumentedFiles) {
  const Shell shell;
  shell.must(kSimulate);
  shell.must("$P run scans -o result");
  EXPECT_EQ(names_in(shell.folder() / "result"),
            (std::set<std::string>{"graph.g2o", "loop_scans.ply", "loops.csv", "map.pcd", "map.ply",
                                   "odometry.tum", "scans.csv", "sensor.yaml", "settings.yaml",
                                   "summary.json", "trajectory.tum", "trajectory_kitti.txt"}));
}

TEST(Run, WritesOnePoseForEachScanWithNineDecimals) {
  const Shell shell;
  shell.must(kSimulate);
  shell.must("$P run scans -o result");
  for (const auto& [name, columns] :
       {std::pair("trajectory.tum", 8U), {"odometry.tum", 8U}, {"trajectory_kitti.txt", 12U}}) {
    const auto lines = lines_of(shell.folder() / "result" / name);
    EXPECT_EQ(lines.size(), 12U) << name;
    for (const std::string& line : lines) {
      const std::vector<std::string> words = split(line, ' ');
      EXPECT_EQ(words.size(), columns) << line;
      for (const std::string& word : words) {
        EXPECT_TRUE(parse_double(word)) << line;
        EXPECT_EQ(word.size() - word.find('.'), 10U) << line;
      }
    }
  }
}

TEST(Run, CountsInItsFilesAgree) {
  const Shell shell;
  shell.must(kLongSimulate);
  shell.must(kLoopyRun + " -o result --truth scans/truth.tum --set key_frames.distance=1");
  const fs::path result = shell.folder() / "result";
  const auto summary = nlohmann::json::parse(read_text(result / "summary.json"));
  EXPECT_EQ(summary["scans"], 60);

  const auto scans = read_csv(result / "scans.csv");
  ASSERT_EQ(scans.size(), 61U);
  const auto key_frame_column =
      std::find(scans[0].begin(), scans[0].end(), "key_frame") - scans[0].begin();
  int key_frames = 0;
  for (const auto& row : scans) {
    ASSERT_EQ(row.size(), scans[0].size());
    key_frames += &row != &scans[0] && row[key_frame_column] != "-1";
  }
  EXPECT_GT(key_frames, 3);
  EXPECT_EQ(summary["key_frames"], key_frames);

  const auto loops = read_csv(result / "loops.csv");
  const auto accepted = std::count_if(loops.begin() + 1, loops.end(),
                                      [](const auto& row) { return row.back() == "accepted"; });
  EXPECT_GT(accepted, 0);
  EXPECT_EQ(summary["loops_accepted"], accepted);
  EXPECT_EQ(summary["loops_refused"], static_cast<std::ptrdiff_t>(loops.size()) - 1 - accepted);

  int vertices = 0;
  int edges = 0;
  for (const std::string& line : lines_of(result / "graph.g2o")) {
    vertices += line.starts_with("VERTEX_SE3:QUAT ");
    edges += line.starts_with("EDGE_SE3:QUAT ");
    EXPECT_EQ(split(line, ' ').size(), line.starts_with("V") ? 9U : 31U);
  }
  EXPECT_EQ(vertices, key_frames);
  const auto added_column = std::find(loops[0].begin(), loops[0].end(), "added") - loops[0].begin();
  const auto added = std::count_if(loops.begin() + 1, loops.end(),
                                   [&](const auto& row) { return row[added_column] == "1"; });
  EXPECT_GT(added, 0);
  EXPECT_LE(added, accepted);
  EXPECT_EQ(edges, key_frames - 1 + added);
}

TEST(Run, FindsTheTruthOfASimulatedDrive) {
  const Shell shell;
  shell.must(kLongSimulate);
  shell.must("$P run scans -o result --truth scans/truth.tum");
  const PoseFile truth = read_poses(shell.folder() / "scans/truth.tum");
  const PoseFile estimate = read_poses(shell.folder() / "result/trajectory.tum");
  const TrajectoryError error = evaluate(associate(truth, estimate));
  EXPECT_EQ(error.pairs, 60U);
  EXPECT_GT(error.truth_length, 5.0);
  EXPECT_LT(error.ate.rmse, 0.1);
  const auto summary = nlohmann::json::parse(read_text(shell.folder() / "result/summary.json"));
  EXPECT_NEAR(summary["errors"]["trajectory"]["ate_m"]["rmse"].get<double>(), error.ate.rmse, 1e-6);
}

TEST(Run, FindsTheSameErrorsAgainstKittisTruthOfTheCamera) {
  const Shell shell;
  shell.must(kLongSimulate);
  const auto errors = [&](const std::string& truth, const std::string& result) {
    shell.must("$P run scans --truth scans/" + truth + " -o " + result);
    const auto summary = nlohmann::json::parse(read_text(shell.folder() / result / "summary.json"));
    return summary["errors"]["trajectory"];
  };
  const auto lidar = errors("truth.tum", "a");
  const auto camera = errors("poses.txt", "b");
  for (const char* error : {"/ate_m/rmse", "/rpe_frame/translation_m/rmse", "/end/x_m"}) {
    const nlohmann::json::json_pointer pointer(error);
    EXPECT_NEAR(camera[pointer].get<double>(), lidar[pointer].get<double>(), 1e-6) << error;
  }
}

TEST(Run, WritesTheKittiTrajectoryInTheFrameOfTheCamera) {
  const Shell shell;
  shell.must(kLongSimulate);
  shell.must("$P run scans -o result");
  // The camera's z axis is the LiDAR's x axis.
  const PoseFile camera = read_poses(shell.folder() / "result/trajectory_kitti.txt");
  const PoseFile lidar = read_poses(shell.folder() / "result/trajectory.tum");
  ASSERT_EQ(camera.poses.size(), lidar.poses.size());
  EXPECT_GT(lidar.poses.back().pose.translation().x(), 3.0);
  EXPECT_NEAR(camera.poses.back().pose.translation().z(), lidar.poses.back().pose.translation().x(),
              1e-6);
}

TEST(Run, WritesTheSameMapInBothFormatsWithAsManyPointsAsItSays) {
  const Shell shell;
  shell.must(kSimulate);
  shell.must("$P run scans -o result");
  const Scan ply = read_ply(shell.folder() / "result/map.ply").scan;
  const Scan pcd = read_pcd(shell.folder() / "result/map.pcd").scan;
  const auto summary = nlohmann::json::parse(read_text(shell.folder() / "result/summary.json"));
  EXPECT_GT(ply.size(), 1000U);
  EXPECT_EQ(summary["map_points"], ply.size());
  EXPECT_EQ(ply.points, pcd.points);
  EXPECT_EQ(ply.intensity, pcd.intensity);
  EXPECT_EQ(ply.intensity.size(), ply.size());
}

// Key frames that a cloud's points are of, with the number of points of each.
std::map<int, int> key_frames_in(const fs::path& ply) {
  const std::string bytes = read_text(ply);
  std::map<int, int> counts;
  for (std::size_t at = bytes.find("end_header\n") + 11; at < bytes.size(); at += 20)
    ++counts[load<std::int32_t>(&bytes[at + 16])];
  return counts;
}

TEST(Run, NamesTheKeyFrameOfEachPointAndKeepsTheScansOfEachLoop) {
  const Shell shell;
  shell.must(kLongSimulate);
  shell.must(kLoopyRun + " -o result");
  const fs::path result = shell.folder() / "result";
  const auto summary = nlohmann::json::parse(read_text(result / "summary.json"));
  const std::map<int, int> map = key_frames_in(result / "map.ply");
  EXPECT_EQ(map.begin()->first, 0);
  EXPECT_LT(map.rbegin()->first, summary["key_frames"].get<int>());
  EXPECT_GT(map.size(), summary["key_frames"].get<std::size_t>() / 2);

  std::set<int> expected;
  for (const auto& row : read_csv(result / "loops.csv"))
    if (row.back() == "accepted") expected.insert({std::stoi(row[0]), std::stoi(row[1])});
  EXPECT_FALSE(expected.empty());
  std::set<int> kept;
  for (const auto& [number, points] : key_frames_in(result / "loop_scans.ply")) {
    kept.insert(number);
    EXPECT_GT(points, 1000);
  }
  EXPECT_EQ(kept, expected);
}

TEST(Run, GivesTheSameBytesAgainAndWithAnyNumberOfThreads) {
  const Shell shell;
  shell.must(kLongSimulate);
  for (const char* variant : {"-o first", "-o again", "-o one --threads 1", "-o four --threads 4"})
    shell.must(kLoopyRun + " " + variant);
  EXPECT_GT(lines_of(shell.folder() / "first/loops.csv").size(), 2U);
  for (const char* other : {"again", "one", "four"})
    expect_same_files(shell.folder() / "first", shell.folder() / other);
}

TEST(Run, GivesTheSameBytesFromTheSettingsAndTheSensorThatItLeft) {
  const Shell shell;
  shell.must(kLongSimulate);
  shell.must(kLoopyRun + " -o first --method lego-loam-sc-paper");
  shell.must("$P run scans -o second --config first/settings.yaml --sensor first/sensor.yaml");
  for (const char* name : {"trajectory.tum", "map.ply", "graph.g2o", "settings.yaml"})
    EXPECT_TRUE(read_text(shell.folder() / "first" / name) ==
                read_text(shell.folder() / "second" / name))
        << name;
}

TEST(Run, TakesTheScansFromFirstOnAndNoMoreThanCount) {
  const Shell shell;
  shell.must(kSimulate);
  shell.must("$P run scans -o result --first 3 --count 5");
  const auto scans = read_csv(shell.folder() / "result/scans.csv");
  ASSERT_EQ(scans.size(), 6U);
  EXPECT_EQ(scans[1][1], "0.300000000");
  EXPECT_EQ(scans[5][1], "0.700000000");
}

// A stream holds the time of each point, a .bin file has it worked out from the azimuth: the middle
// of the sweep comes out a little apart.
TEST(Run, FollowsAStreamAsItFollowsAFolder) {
  const Shell shell;
  shell.must(kLongSimulate);
  shell.must("$P run scans -o folder");
  shell.must("$P simulate parking --count 60 --sensor rs16 -o - | $P run - -o stream");
  shell.must("$P simulate parking --count 60 --sensor rs16 -o - > file.scans");
  shell.must("$P run file.scans -o file");
  const Trajectory folder = read_poses(shell.folder() / "folder/trajectory.tum").poses;
  const Trajectory stream = read_poses(shell.folder() / "stream/trajectory.tum").poses;
  ASSERT_EQ(stream.size(), folder.size());
  EXPECT_LT(largest_difference(folder, stream), 0.05);
  EXPECT_TRUE(read_text(shell.folder() / "stream/trajectory.tum") ==
              read_text(shell.folder() / "file/trajectory.tum"));
}

TEST(Run, NumbersItsFoldersAndLinksTheLatest) {
  const Shell shell;
  shell.must(kSimulate);
  shell.must("$P run scans && $P run scans");
  EXPECT_EQ(names_in(shell.folder() / "runs"),
            (std::set<std::string>{"latest", "scans-1", "scans-2"}));
  EXPECT_EQ(fs::read_symlink(shell.folder() / "runs/latest"), "scans-2");
  EXPECT_TRUE(fs::exists(shell.folder() / "runs/latest/trajectory.tum"));
}

TEST(Run, PrintsNothingWhenAskedToBeQuiet) {
  const Shell shell;
  shell.must(kSimulate);
  const Outcome outcome = shell("$P run scans -o result --quiet");
  EXPECT_EQ(outcome.out + outcome.err, "");
}

}  // namespace
}  // namespace lego_loam_sc
