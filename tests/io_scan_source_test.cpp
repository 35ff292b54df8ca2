// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "io/bytes.hpp"
#include "io/scan_source.hpp"
#include "io/scan_stream.hpp"
#include "io_test_files.hpp"

namespace lego_loam_sc {
namespace {

// One point, whose x tells the scan.
std::string bin_of(float x) {
  std::string bytes;
  for (const float value : {x, 2.0F, 3.0F, 0.5F}) append(bytes, value);
  return bytes;
}

// Two points with times.
std::string pcd_of(const std::string& first, const std::string& last) {
  return "FIELDS x y z timestamp\nSIZE 4 4 4 8\nTYPE F F F F\nWIDTH 2\nHEIGHT 1\nDATA ascii\n"
         "1 2 3 " +
         first + "\n1 2 3 " + last + "\n";
}

std::vector<Scan> read_all(ScanSource& source) {
  std::vector<Scan> scans;
  while (auto scan = source.next()) scans.push_back(std::move(*scan));
  return scans;
}

std::string open_error(const std::filesystem::path& path) {
  return error_of([&] { open_scans(path.string()); });
}

TEST(ScanSource, ReadsAKittiSequence) {
  const TemporaryFolder folder;
  folder.write("velodyne/000000.bin", bin_of(0));
  folder.write("velodyne/000001.bin", bin_of(1));
  folder.write("times.txt", "0.000000e+00\n1.041284e-01\n");
  folder.write("calib.txt", "P0: 1 2 3\nTr: 0 -1 0 0.5 0 0 -1 0 1 0 0 0\n");
  const auto source = open_scans(folder.path().string());
  EXPECT_EQ(source->size(), 2U);
  EXPECT_TRUE(source->facts().kitti);
  ASSERT_TRUE(source->facts().T_camera_lidar);
  EXPECT_EQ(*source->facts().T_camera_lidar * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.5, 0, 1));
  EXPECT_TRUE(source->notes().empty());
  const std::vector<Scan> scans = read_all(*source);
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans[1].stamp_ns, 104'128'400);
  EXPECT_EQ(scans[1].points[0].x(), 1.0F);
}

TEST(ScanSource, ReadsAFolderInNumericOrderAtTenHertz) {
  const TemporaryFolder folder;
  for (const int i : {10, 9, 100}) folder.write(std::to_string(i) + ".bin", bin_of(i));
  folder.write("readme.md", "not a scan");
  const auto source = open_scans(folder.path().string());
  EXPECT_FALSE(source->facts().kitti);
  EXPECT_EQ(source->notes().size(), 1U);
  const std::vector<Scan> scans = read_all(*source);
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[0].points[0].x(), 9.0F);
  EXPECT_EQ(scans[1].points[0].x(), 10.0F);
  EXPECT_EQ(scans[2].points[0].x(), 100.0F);
  EXPECT_EQ(scans[2].stamp_ns, 200'000'000);
}

TEST(ScanSource, GoesOnAfterABadScan) {
  const TemporaryFolder folder;
  folder.write("0.bin", bin_of(0));
  folder.write("1.bin", "short");
  folder.write("2.bin", bin_of(2));
  const auto source = open_scans(folder.path().string());
  EXPECT_TRUE(source->next());
  const std::string message = error_of([&] { source->next(); });
  EXPECT_NE(message.find("1.bin has 5 bytes"), message.npos);
  const auto scan = source->next();
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->points[0].x(), 2.0F);
  EXPECT_EQ(scan->stamp_ns, 200'000'000);
  EXPECT_FALSE(source->next());
}

TEST(ScanSource, TheUnitOfAFullSweepHoldsForSparseOnes) {
  const TemporaryFolder folder;
  folder.write("0.pcd", pcd_of("0", "100000"));
  folder.write("1.pcd", pcd_of("100", "7000"));
  const auto source = open_scans(folder.path().string());
  const std::vector<Scan> scans = read_all(*source);
  EXPECT_EQ(scans[0].offset_ns, (std::vector<std::int32_t>{0, 100'000'000}));
  EXPECT_EQ(scans[1].offset_ns, (std::vector<std::int32_t>{100'000, 7'000'000}));
  ASSERT_EQ(source->notes().size(), 2U);
  EXPECT_NE(source->notes()[1].find("microseconds"), std::string::npos);
}

TEST(ScanSource, AScanThatIsTooShortWaitsForTheUnitOfTheNext) {
  const TemporaryFolder folder;
  folder.write("0.pcd", pcd_of("0", "4000"));
  folder.write("1.pcd", "no point file");
  folder.write("2.pcd", pcd_of("100", "100100"));
  const auto source = open_scans(folder.path().string());
  EXPECT_EQ(source->next()->offset_ns, (std::vector<std::int32_t>{0, 4'000'000}));
  EXPECT_THROW(source->next(), InputError);
  EXPECT_EQ(source->next()->offset_ns, (std::vector<std::int32_t>{100'000, 100'100'000}));
}

TEST(ScanSource, AbsoluteTimesOfThePointsGiveTheStampWithoutTimesFile) {
  const TemporaryFolder folder;
  folder.write("0.pcd", pcd_of("1600000000.5", "1600000000.625"));
  EXPECT_EQ(open_scans(folder.path().string())->next()->stamp_ns, 1'600'000'000'500'000'000);
  folder.write("times.txt", "7\n");
  EXPECT_EQ(open_scans(folder.path().string())->next()->stamp_ns, 7'000'000'000);
}

TEST(ScanSource, ReadsASingleScanAndAStreamFile) {
  const TemporaryFolder folder;
  const auto scan = folder.write("a.bin", bin_of(4));
  EXPECT_EQ(read_all(*open_scans(scan.string())).size(), 1U);
  std::ostringstream stream;
  ScanStreamWriter writer(stream);
  writer.write(Scan{});
  writer.write(Scan{});
  const auto file = folder.write("recording", stream.str());
  EXPECT_EQ(read_all(*open_scans(file.string())).size(), 2U);
}

TEST(ScanSource, ReadsTheFactsOfTheDataset) {
  const TemporaryFolder folder;
  folder.write("0.bin", bin_of(0));
  DatasetFacts facts;
  facts.sensor = "hdl32e";
  facts.motion_compensated = true;
  facts.elevation_correction_deg = 0.25;
  facts.point_times = TimeUnit::microseconds;
  write_dataset_yaml(folder.path(), facts);
  const DatasetFacts read = open_scans(folder.path().string())->facts();
  EXPECT_EQ(read.sensor, facts.sensor);
  EXPECT_EQ(read.motion_compensated, true);
  EXPECT_EQ(read.elevation_correction_deg, 0.25);
  EXPECT_EQ(read.point_times, TimeUnit::microseconds);
  folder.write("dataset.yaml", "sensors: vlp16\n");
  const std::string message = open_error(folder.path());
  EXPECT_NE(message.find("dataset.yaml, line 1: there is no sensors; the nearest is sensor"),
            message.npos);
  folder.write("dataset.yaml", "point_times: minutes\n");
  EXPECT_NE(open_error(folder.path()).find("s, ms, us, ns or none"), std::string::npos);
}

TEST(ScanSource, SaysWhatIsWrongWithAnInput) {
  const TemporaryFolder folder;
  EXPECT_NE(open_error(folder.path() / "none").find("does not exist"), std::string::npos);
  EXPECT_NE(open_error(folder.path()).find("contains no scans"), std::string::npos);
  EXPECT_NE(open_error(folder.write("a.bag", "#ROSBAG V2.0")).find("is neither a folder of scans"),
            std::string::npos);
  folder.write("0.bin", bin_of(0));
  folder.write("times.txt", "0\n0.1\n");
  EXPECT_NE(open_error(folder.path()).find("has 2 times for 1 scans"), std::string::npos);
  folder.write("times.txt", "0 1\n");
  EXPECT_NE(open_error(folder.path()).find("times.txt, line 1"), std::string::npos);
  folder.write("times.txt", "0\n");
  folder.write("calib.txt", "Tr: 1 0 0\n");
  EXPECT_NE(open_error(folder.path()).find("12 numbers"), std::string::npos);
  folder.write("0.pcd", "");
  EXPECT_NE(open_error(folder.path()).find("different kinds (.bin, .pcd)"), std::string::npos);
}

}  // namespace
}  // namespace lego_loam_sc
