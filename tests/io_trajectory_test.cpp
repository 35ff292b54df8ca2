// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>

#include "core/text.hpp"
#include "io/append_file.hpp"
#include "io/atomic_file.hpp"
#include "io/file.hpp"
#include "io/g2o.hpp"
#include "io/trajectory.hpp"
#include "io_test_files.hpp"

namespace lego_loam_sc {
namespace {

Trajectory make_trajectory() {
  Trajectory trajectory;
  for (int i = 0; i < 20; ++i) {
    StampedPose pose;
    pose.stamp_ns = 1'595'444'159'265'510'001 + i * 100'000'000LL;
    pose.pose = exp_se3((Vector6() << 3.0 * i, -i, 0.1, 0.1 * i, 0.05, -0.3 * i).finished());
    trajectory.push_back(pose);
  }
  return trajectory;
}

TEST(TrajectoryFiles, TumGivesBackStampsToTheNanosecondAndPoses) {
  const TemporaryFolder folder;
  const Trajectory trajectory = make_trajectory();
  write_tum(folder.path() / "a.tum", trajectory);
  const PoseFile file = read_poses(folder.path() / "a.tum");
  EXPECT_TRUE(file.has_stamps);
  ASSERT_EQ(file.poses.size(), trajectory.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    EXPECT_EQ(file.poses[i].stamp_ns, trajectory[i].stamp_ns);
    EXPECT_TRUE(file.poses[i].pose.isApprox(trajectory[i].pose, 1e-8));
  }
}

TEST(TrajectoryFiles, KittiGivesBackPosesAndNoStamps) {
  const TemporaryFolder folder;
  const Trajectory trajectory = make_trajectory();
  write_kitti(folder.path() / "a.txt", trajectory);
  const PoseFile file = read_poses(folder.path() / "a.txt");
  EXPECT_FALSE(file.has_stamps);
  ASSERT_EQ(file.poses.size(), trajectory.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    EXPECT_EQ(file.poses[i].stamp_ns, static_cast<std::int64_t>(i));
    EXPECT_TRUE(file.poses[i].pose.isApprox(trajectory[i].pose, 1e-8));
  }
}

TEST(TrajectoryFiles, ACalibrationMovesKittiPosesIntoTheCamera) {
  const TemporaryFolder folder;
  Pose T_camera_lidar = Pose::Identity();  // camera: x right, y down, z forward
  T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  StampedPose forward;
  forward.pose.translation() = Eigen::Vector3d(5, 2, 1);
  write_kitti(folder.path() / "a.txt", {forward}, T_camera_lidar);
  const Pose pose = read_poses(folder.path() / "a.txt").poses.front().pose;
  EXPECT_TRUE(pose.translation().isApprox(Eigen::Vector3d(-2, -1, 5), 1e-9));
}

TEST(TrajectoryFiles, LinesHaveNineDecimals) {
  StampedPose pose;
  pose.stamp_ns = 1'000'000'001;
  pose.pose.translation().x() = 0.5;
  EXPECT_EQ(tum_line(pose),
            "1.000000001 0.500000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
            "1.000000000\n");
  EXPECT_EQ(to_seconds(-1), "-0.000000001");
  EXPECT_EQ(to_seconds(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
}

TEST(TrajectoryFiles, CommentsAndBlankLinesAreSkipped) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.tum", "# stamp x y z\n\n1.5e0 1 2 3 0 0 0 1 # here\r\n");
  const PoseFile poses = read_poses(file);
  ASSERT_EQ(poses.poses.size(), 1U);
  EXPECT_EQ(poses.poses[0].stamp_ns, 1'500'000'000);
}

TEST(TrajectoryFiles, WrongLinesAreNamed) {
  const auto expect = [&](const std::string& text, const std::string& words) {
    const std::string message = error_of([&] { parse_poses(text, "a.tum"); });
    EXPECT_NE(message.find(words), message.npos) << message;
  };
  const std::string good = "0 0 0 0 0 0 0 1\n";
  expect(good + "1 0 0\n", "line 2: 3 columns");
  expect(good + "1 0 0 0 0 1 0 0 0 0 1 0\n", "line 2: 12 columns; every pose needs 8");
  expect(good + "1 0 0 zero 0 0 0 1\n", "line 2: \"zero\"");
  expect(good + "1 0 0 nan 0 0 0 1\n", "line 2: \"nan\"");
  expect(good + "1 0 0 0 0 0 0 0\n", "length 0");
  expect("1e300 0 0 0 0 0 0 1\n", "not in seconds");
  expect("1 0 0 0 0 1 0 0 0 0 -1 0\n", "not a rotation");
  expect("# nothing\n", "contains no pose");
}

TEST(TrajectoryFiles, SurviveDamage) {
  const auto parse = [](const std::string& text) { parse_poses(text, "a.txt"); };
  read_damaged(tum_line(make_trajectory()[3]) + tum_line(make_trajectory()[4]), parse);
  read_damaged(kitti_line(make_trajectory()[3].pose), parse);
}

TEST(G2o, WritesTranslationFirstAndTheUpperTriangle) {
  const TemporaryFolder folder;
  G2oEdge edge{3, 4, Pose::Identity(), Matrix6::Zero()};
  edge.T_from_to.translation() = Eigen::Vector3d(1, 2, 3);
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column)
      edge.information(row, column) = edge.information(column, row) = 10 * row + column;
  write_g2o(folder.path() / "graph.g2o", {{3, Pose::Identity()}}, {edge});
  EXPECT_EQ(read_file(folder.path() / "graph.g2o"),
            "VERTEX_SE3:QUAT 3 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
            "0.000000000 1.000000000\n"
            "EDGE_SE3:QUAT 3 4 1.000000000 2.000000000 3.000000000 0.000000000 0.000000000 "
            "0.000000000 1.000000000 0 1 2 3 4 5 11 12 13 14 15 22 23 24 25 33 34 35 44 45 55\n");
}

TEST(AtomicFile, IsThereOnlyAfterCommit) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.txt", "old");
  {
    AtomicFile file(path);
    file.write("half");
  }
  EXPECT_EQ(read_file(path), "old");
  write_file(path, "new");
  EXPECT_EQ(read_file(path), "new");
  using Iterator = std::filesystem::directory_iterator;
  EXPECT_EQ(std::distance(Iterator(folder.path()), Iterator()), 1);
}

TEST(AtomicFile, SaysWhyItCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string missing =
      error_of([&] { write_file(folder.path() / "none" / "a.txt", "text"); });
  EXPECT_NE(missing.find("a.txt cannot be written: No such file"), missing.npos);
  std::filesystem::create_directory(folder.path() / "taken");
  EXPECT_THROW(write_file(folder.path() / "taken", "text"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "taken.part"));
}

TEST(AtomicFile, NoticesAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder.path() / "a.txt.part");
  const std::string message = error_of([&] { write_file(folder.path() / "a.txt", "text"); });
  EXPECT_NE(message.find("No space left"), message.npos);
}

TEST(AppendFile, IsCutToItsWholeLinesWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, SIG_IGN);
  const rlimit small{25, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  {
    AppendFile file(folder.path() / "a.csv");
    file.append("first line\n");
    message = error_of([&] { file.append("second line, too long\n"); });
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NE(message.find("a.csv: cannot be written"), message.npos) << message;
  EXPECT_EQ(read_file(folder.path() / "a.csv"), "first line\n");
}

TEST(ReadFile, TakesNoEndlessDevice) {
  const std::string message = error_of([] { read_file("/dev/zero"); });
  EXPECT_NE(message.find("/dev/zero"), message.npos);
  EXPECT_EQ(read_file("/dev/null"), "");
}

TEST(NaturalOrder, ComparesNumbersByTheirSize) {
  EXPECT_TRUE(natural_less("9.pcd", "10.pcd"));
  EXPECT_TRUE(natural_less("scan_9.pcd", "scan_10.pcd"));
  EXPECT_TRUE(natural_less("scan_000009.pcd", "scan_10.pcd"));
  EXPECT_TRUE(natural_less("1600000000.099.pcd", "1600000000.100.pcd"));
  EXPECT_TRUE(natural_less("a1b2", "a1b10"));
  EXPECT_TRUE(natural_less("a", "b1"));
  EXPECT_TRUE(natural_less("a", "a0"));
  EXPECT_TRUE(natural_less("01", "1"));
  EXPECT_FALSE(natural_less("1", "01"));
  EXPECT_FALSE(natural_less("10", "10"));
  EXPECT_TRUE(natural_less("99999999999999999999998", "99999999999999999999999"));
}

TEST(Text, NumbersReadBackAsWritten) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 1000; ++i) {
    const auto value = static_cast<double>(random()) * std::pow(10.0, -(i % 30));
    EXPECT_EQ(parse_double(to_text(value)), value);
  }
  EXPECT_EQ(to_text(0.35), "0.35");
  EXPECT_EQ(parse_double("+1.5"), 1.5);
  EXPECT_FALSE(parse_double("1.5x"));
  EXPECT_FALSE(parse_double("+-1"));
  EXPECT_FALSE(parse_double(""));
}

TEST(Text, SecondsKeepTheirNanoseconds) {
  EXPECT_EQ(parse_seconds("1595444159.265510001"), 1'595'444'159'265'510'001);
  EXPECT_EQ(parse_seconds("1.041284e-01"), 104'128'400);
  EXPECT_EQ(parse_seconds("-0.000000001"), -1);
  EXPECT_FALSE(parse_seconds("1e10"));
  EXPECT_FALSE(parse_seconds("nan"));
}

}  // namespace
}  // namespace lego_loam_sc
