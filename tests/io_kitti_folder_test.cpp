// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/file.hpp"
#include "io/kitti_folder.hpp"
#include "io/scan_source.hpp"
#include "io/trajectory.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

class SimKittiFolder : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  static Scan scan_at(std::int64_t stamp_ns) {
    Scan scan;
    scan.stamp_ns = stamp_ns;
    scan.points = {{1.0f, 2.0f, 3.0f}, {-4.0f, 5.5f, 0.25f}};
    scan.intensity = {0.5f, 0.75f};
    return scan;
  }

  static Pose pose(double x, double yaw) {
    Pose result = Pose::Identity();
    result.translation() = Vector3d(x, 2.0, -1.0);
    result.linear() = rotation_from_rpy(0.1, -0.2, yaw);
    return result;
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("lego_loam_sc_sim_folder_" + std::to_string(getpid()));
  const DatasetFacts facts_ = [] {
    DatasetFacts facts;
    facts.sensor = "vlp16";
    facts.motion_compensated = false;
    return facts;
  }();
};

TEST_F(SimKittiFolder, HoldsEachScanAsFourFloatsPerPoint) {
  KittiFolder folder(folder_, facts_);
  folder.add(scan_at(0), pose(0.0, 0.0));
  const std::string bytes = read_file(folder_ / "velodyne" / "000000.bin");
  const std::vector<float> expected = {1.0f, 2.0f, 3.0f, 0.5f, -4.0f, 5.5f, 0.25f, 0.75f};
  ASSERT_EQ(bytes.size(), expected.size() * sizeof(float));
  EXPECT_EQ(std::memcmp(bytes.data(), expected.data(), bytes.size()), 0);
}

TEST_F(SimKittiFolder, TruthIsThePoseAtTheStampInTheWorldFrame) {
  KittiFolder folder(folder_, facts_);
  folder.add(scan_at(0), pose(3.0, 0.4));
  folder.add(scan_at(100'000'000), pose(4.0, 0.5));
  const PoseFile truth = read_poses(folder_ / "truth.tum");
  ASSERT_EQ(truth.poses.size(), 2u);
  EXPECT_EQ(truth.poses[1].stamp_ns, 100'000'000);
  EXPECT_TRUE(truth.poses[0].pose.isApprox(pose(3.0, 0.4), 1e-8));
  EXPECT_TRUE(truth.poses[1].pose.isApprox(pose(4.0, 0.5), 1e-8));
  EXPECT_EQ(read_file(folder_ / "times.txt"), "0.000000000\n0.100000000\n");
}

TEST_F(SimKittiFolder, KittiPosesAreTheCamerasRelativeToTheFirst) {
  KittiFolder folder(folder_, facts_);
  Pose forward = Pose::Identity();  // 2 m ahead and a little to the left, turned to the left
  forward.translation() = Vector3d(2.0, 0.5, 0.0);
  forward.linear() = rotation_from_rpy(0.0, 0.0, 0.3);
  folder.add(scan_at(0), pose(3.0, 0.4));
  folder.add(scan_at(100'000'000), pose(3.0, 0.4) * forward);
  const PoseFile poses = read_poses(folder_ / "poses.txt");
  ASSERT_EQ(poses.poses.size(), 2u);
  EXPECT_TRUE(poses.poses[0].pose.isApprox(Pose::Identity(), 1e-8));
  const Pose camera = poses.poses[1].pose;  // x right, y down, z forward
  EXPECT_LT((camera.translation() - Vector3d(-0.5, 0.0, 2.0)).norm(), 1e-8);
  EXPECT_LT((log_so3(camera.linear()) - Vector3d(0.0, -0.3, 0.0)).norm(), 1e-8);
}

TEST_F(SimKittiFolder, OpensAsASourceOfTheSameScans) {
  {
    KittiFolder folder(folder_, facts_);
    folder.add(scan_at(0), pose(0.0, 0.0));
    folder.add(scan_at(100'000'000), pose(1.0, 0.0));
  }
  const auto source = open_scans(folder_.string());
  EXPECT_EQ(source->facts().sensor, "vlp16");
  EXPECT_EQ(source->facts().motion_compensated, false);
  ASSERT_TRUE(source->facts().T_camera_lidar);
  EXPECT_TRUE((*source->facts().T_camera_lidar * Vector3d(1, 2, 3)).isApprox(Vector3d(-2, -3, 1)));
  source->next();
  const auto second = source->next();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->stamp_ns, 100'000'000);
  EXPECT_EQ(second->points, scan_at(0).points);
  EXPECT_FALSE(source->next());
}

TEST_F(SimKittiFolder, RefusesAFolderWithContent) {
  fs::create_directories(folder_);
  EXPECT_NO_THROW(KittiFolder(folder_, facts_));  // an empty one is fine
  EXPECT_THROW(KittiFolder(folder_, facts_), InputError);
}

TEST_F(SimKittiFolder, RefusesAPlaceWhereNoFolderCanBe) {
  std::ofstream(folder_) << "a file";
  EXPECT_THROW(KittiFolder(folder_, facts_), InputError);
  EXPECT_THROW(KittiFolder(folder_ / "below", facts_), InputError);
}

}  // namespace
}  // namespace lego_loam_sc
