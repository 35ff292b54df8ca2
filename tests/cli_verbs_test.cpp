// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "cli_program.hpp"
#include "core/pose.hpp"
#include "io/bytes.hpp"
#include "io/trajectory.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

std::set<std::string> keys_of(const nlohmann::json& object) {
  std::set<std::string> keys;
  for (const auto& item : object.items()) keys.insert(item.key());
  return keys;
}

// The second scan is turned by `yaw` as if the vehicle had come from elsewhere.
void turn_scan(const fs::path& file, double yaw) {
  std::string bytes = read_text(file);
  const Eigen::Matrix3f R = rotation_from_rpy(0.0, 0.0, yaw).cast<float>();
  for (std::size_t at = 0; at < bytes.size(); at += 4 * sizeof(float)) {
    const auto [x, y, z] = load<std::array<float, 3>>(&bytes[at]);
    const Eigen::Vector3f turned = R * Eigen::Vector3f(x, y, z);
    std::memcpy(&bytes[at], turned.data(), sizeof(turned));
  }
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST(Sensor, LearnsASensorFileThatARunTakes) {
  const Shell shell;
  shell.must("$P simulate parking --count 3 --sensor vlp32c -o - > scans");
  shell.must("$P sensor scans --count 2 -o mine.yaml");
  EXPECT_EQ(shell.must("$P sensor scans --count 2"), read_text(shell.folder() / "mine.yaml"));
  const std::string facts = shell.must("$P config --sensor mine.yaml");
  EXPECT_NE(facts.find("elevation_deg: [-25, -15.639, -11.31, "), facts.npos) << facts;
  EXPECT_NE(facts.find("\ncolumns: 1800 "), facts.npos) << facts;
  shell.must("$P run scans --sensor mine.yaml -o result --quiet");
}

TEST(Match, FindsTheTransformBetweenTwoSimulatedScansHoweverTheyAreTurned) {
  constexpr double kYaw = 2.5;
  const Shell shell;
  shell.must("$P simulate parking --count 11 --sensor rs16 --distort off -o scans");
  turn_scan(shell.folder() / "scans/velodyne/000010.bin", kYaw);
  const auto match = nlohmann::json::parse(shell.must(
      "$P match scans/velodyne/000000.bin scans/velodyne/000010.bin --sensor rs16 --json"));
  EXPECT_EQ(keys_of(match), (std::set<std::string>{"accepted", "verdict", "scan_context_distance",
                                                   "yaw_deg", "overlap", "rmse_m", "T_a_b"}));
  Pose T_a_b = Pose::Identity();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      T_a_b.matrix()(row, column) = match["T_a_b"][row][column].get<double>();

  const Trajectory truth = read_poses(shell.folder() / "scans/truth.tum").poses;
  Pose expected = truth[0].pose.inverse() * truth[10].pose;
  expected.linear() = expected.linear() * rotation_from_rpy(0.0, 0.0, -kYaw);
  const Pose error = expected.inverse() * T_a_b;
  EXPECT_LT(error.translation().norm(), 0.1);
  EXPECT_LT(degrees(rotation_angle(error)), 1.0);
  EXPECT_NEAR(match["yaw_deg"].get<double>(), degrees(-kYaw), 10.0);
  EXPECT_EQ(match["accepted"], true);
}

TEST(Match, RefusesScansWhoseScanContextsAreFartherApartThanTheThreshold) {
  const Shell shell;
  shell.must("$P simulate parking --count 1 --sensor rs16 -o scans");
  const auto same = nlohmann::json::parse(shell.must(
      "$P match scans/velodyne/000000.bin scans/velodyne/000000.bin --sensor rs16 --json"));
  EXPECT_NEAR(same["scan_context_distance"].get<double>(), 0.0, 1e-6);
  const auto strict = nlohmann::json::parse(
      shell.must("$P match scans/velodyne/000000.bin scans/velodyne/000000.bin --sensor rs16 "
                 "--json --set loop.scan_context.threshold=0"));
  EXPECT_EQ(strict["accepted"], false);
  EXPECT_EQ(strict["verdict"], "no_candidate");
}

TEST(Evaluate, FindsNoErrorInATrajectoryComparedWithItself) {
  const Shell shell;
  shell.must("$P simulate parking --count 40 --sensor rs16 -o scans");
  const auto list =
      nlohmann::json::parse(shell.must("$P evaluate --json scans/truth.tum scans/truth.tum"));
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["pairs"], 40);
  EXPECT_NEAR(list[0]["ate_m"]["rmse"].get<double>(), 0.0, 1e-9);
  EXPECT_NEAR(list[0]["rpe_frame"]["translation_m"]["max"].get<double>(), 0.0, 1e-9);
  EXPECT_NEAR(list[0]["rpe_metre"]["rotation_deg"]["max"].get<double>(), 0.0, 1e-6);
  EXPECT_TRUE(list[0]["kitti"].is_null());  // 100 m are needed
}

TEST(Config, PrintsSettingsThatLoadAgainAsTheSameText) {
  const Shell shell;
  for (const char* method : {"lego-loam-sc", "lego-loam-sc-paper", "lego-loam", "loam"}) {
    const std::string text = shell.must("$P config --method " + std::string(method));
    shell.files().write("settings.yaml", text);
    EXPECT_EQ(shell.must("$P config --config settings.yaml"), text) << method;
  }
}

TEST(Config, LetsTheCommandLineWinOverTheFileAndTheFileOverTheMethod) {
  const Shell shell;
  shell.files().write("settings.yaml", "mapping:\n  radius: 60\n  every: 3\n");
  const std::string text = shell.must(
      "$P config --method loam --config settings.yaml --set mapping.every=2 --set "
      "features.neighbours=7");
  EXPECT_NE(text.find("  radius: 60  #"), text.npos);
  EXPECT_NE(text.find("  every: 2  #"), text.npos);
  EXPECT_NE(text.find("  neighbours: 7  #"), text.npos);
  EXPECT_NE(text.find("  two_step: false  #"), text.npos);  // the method's own
}

TEST(Verb, ThatIsNotBuiltInRunsTheProgramOfThatNameFromThePath) {
  const Shell shell;
  const fs::path script =
      shell.files().write("bin/lego-loam-sc-greet", "#!/bin/sh\necho \"hello $*\"\nexit 7\n");
  fs::permissions(script, fs::perms::owner_all);
  const Outcome outcome = shell("PATH=\"$PWD/bin:$PATH\" \"$P\" greet --loudly 'two words'");
  EXPECT_EQ(outcome.out, "hello --loudly two words\n");
  EXPECT_EQ(outcome.exit_code, 7);
}

TEST(Verb, ThatIsBuiltInIsNeverTakenFromThePath) {
  const Shell shell;
  const fs::path script = shell.files().write("bin/lego-loam-sc-config", "#!/bin/sh\nexit 7\n");
  fs::permissions(script, fs::perms::owner_all);
  EXPECT_EQ(shell("PATH=\"$PWD/bin:$PATH\" \"$P\" config").exit_code, 0);
}

TEST(Simulate, GivesTheSameScansForTheSameSeedAndOthersForAnother) {
  const Shell shell;
  shell.must("$P simulate parking --count 2 -o a && $P simulate parking --count 2 -o b");
  shell.must("$P simulate parking --count 2 --seed 2 -o c");
  const auto scan = [&](const char* folder) {
    return read_text(shell.folder() / folder / "velodyne/000001.bin");
  };
  EXPECT_TRUE(scan("a") == scan("b"));
  EXPECT_FALSE(scan("a") == scan("c"));
}

}  // namespace
}  // namespace lego_loam_sc
