// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/bin.hpp"
#include "io/bytes.hpp"
#include "io/cloud_writer.hpp"
#include "io/lzf.hpp"
#include "io/pcd.hpp"
#include "io/ply.hpp"
#include "io_test_files.hpp"

namespace lego_loam_sc {
namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();

// Three points; the second has no return.
void expect_three_points(const RawScan& raw) {
  const Scan& scan = raw.scan;
  ASSERT_EQ(scan.size(), 3U);
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(1.5F, -2.0F, 0.25F));
  EXPECT_TRUE(scan.points[1].array().isNaN().all());
  EXPECT_EQ(scan.points[2], Eigen::Vector3f(-4.0F, 8.0F, 16.0F));
  EXPECT_EQ(scan.intensity, (std::vector<float>{10.0F, 0.0F, 255.0F}));
  EXPECT_EQ(scan.ring, (std::vector<std::uint16_t>{0, 7, 15}));
  ASSERT_EQ(raw.time.size(), 3U);
  EXPECT_EQ(raw.time[0], 0.0);
  EXPECT_TRUE(std::isnan(raw.time[1]));
  EXPECT_EQ(raw.time[2], 99'000'000.0);
  EXPECT_EQ(raw.time_type, NumberType::uint32);
}

constexpr const char* kPcdHead =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x _ y z intensity ring t\n"
    "SIZE 4 1 8 4 1 2 4\nTYPE F U F F U U U\nCOUNT 1 3 1 1 1 1 1\nWIDTH 3\nHEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\n";

struct Point {
  float x;
  double y;
  float z;
  std::uint8_t intensity;
  std::uint16_t ring;
  std::uint32_t t;
};
const std::vector<Point> kPoints = {{1.5F, -2.0, 0.25F, 10, 0, 0},
                                    {kNan, std::nan(""), kNan, 0, 7, 123},
                                    {-4.0F, 8.0, 16.0F, 255, 15, 99'000'000}};

std::string pcd_binary() {
  std::string bytes = std::string(kPcdHead) + "DATA binary\n";
  for (const Point& p : kPoints) {
    append(bytes, p.x);
    bytes += "pad";
    append(bytes, p.y);
    append(bytes, p.z);
    append(bytes, p.intensity);
    append(bytes, p.ring);
    append(bytes, p.t);
  }
  return bytes;
}

// Literal runs alone: valid LZF that needs no compressor.
std::string store_lzf(const std::string& bytes) {
  std::string packed;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string run = bytes.substr(at, 32);
    packed += static_cast<char>(run.size() - 1) + run;
  }
  return packed;
}

std::string pcd_compressed() {
  std::string fields;
  for (const Point& p : kPoints) append(fields, p.x);
  for (std::size_t i = 0; i < kPoints.size(); ++i) fields += "pad";
  for (const Point& p : kPoints) append(fields, p.y);
  for (const Point& p : kPoints) append(fields, p.z);
  for (const Point& p : kPoints) append(fields, p.intensity);
  for (const Point& p : kPoints) append(fields, p.ring);
  for (const Point& p : kPoints) append(fields, p.t);
  const std::string packed = store_lzf(fields);
  std::string bytes = std::string(kPcdHead) + "DATA binary_compressed\n";
  append(bytes, static_cast<std::uint32_t>(packed.size()));
  append(bytes, static_cast<std::uint32_t>(fields.size()));
  return bytes + packed;
}

std::string pcd_ascii() {
  return std::string(kPcdHead) +
         "DATA ascii\n1.5 0 0 0 -2 0.25 10 0 0\nnan 0 0 0 nan nan 0 7 123\n"
         "-4 0 0 0 8 1.6e1 255 15 99000000\n";
}

std::string ply_head(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment made by hand\nelement camera 1\nproperty uchar id\nelement face 2\n"
         "property list uchar int corners\nproperty short colour\nelement vertex 3\n"
         "property float x\nproperty double y\nproperty float32 z\nproperty uchar intensity\n"
         "property ushort ring\nproperty uint t\nelement end 1\nproperty char c\nend_header\n";
}

template <class T>
void append_as(std::string& bytes, T value, bool big_endian) {
  std::string one;
  append(one, value);
  if (big_endian) std::reverse(one.begin(), one.end());
  bytes += one;
}

std::string ply_binary(bool big) {
  std::string bytes = ply_head(big ? "binary_big_endian" : "binary_little_endian");
  bytes += '\7';
  for (const int corners : {3, 0}) {
    bytes += static_cast<char>(corners);
    for (int i = 0; i < corners; ++i) append_as(bytes, std::int32_t{i}, big);
    append_as(bytes, std::int16_t{-1}, big);
  }
  for (const Point& p : kPoints) {
    append_as(bytes, p.x, big);
    append_as(bytes, p.y, big);
    append_as(bytes, p.z, big);
    append_as(bytes, p.intensity, big);
    append_as(bytes, p.ring, big);
    append_as(bytes, p.t, big);
  }
  return bytes + "c";
}

std::string ply_ascii() {
  return ply_head("ascii") +
         "7\n3 0 1 2 -1\n0 -1\n1.5 -2 0.25 10 0 0\nnan nan nan 0 7 123\n-4 8 16 255 15 "
         "99000000\n5\n";
}

std::string with(std::string text, const std::string& old, const std::string& now) {
  return text.replace(text.find(old), old.size(), now);
}

TEST(PcdReader, ReadsAllEncodingsWithPaddingAndNan) {
  const TemporaryFolder folder;
  for (const std::string& bytes : {pcd_ascii(), pcd_binary(), pcd_compressed()})
    expect_three_points(read_pcd(folder.write("a.pcd", bytes)));
}

TEST(PcdReader, ReadsFilesThatAreFilledUpToAMemoryPage) {
  const TemporaryFolder folder;
  expect_three_points(read_pcd(folder.write("a.pcd", pcd_binary() + std::string(4000, '\0'))));
}

TEST(PcdReader, ReadsOldHeadersWithoutCountAndPoints) {
  const TemporaryFolder folder;
  const RawScan raw = read_pcd(folder.write("a.pcd",
                                            "VERSION .5\r\nFIELDS x y z\r\nSIZE 4 4 4\r\n"
                                            "TYPE F F F\r\nWIDTH 1\r\nDATA ascii\r\n1 2 3\r\n"));
  ASSERT_EQ(raw.scan.size(), 1U);
  EXPECT_EQ(raw.scan.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(raw.scan.intensity.empty());
  EXPECT_TRUE(raw.time.empty());
}

TEST(PcdReader, RefusesHeadersThatLie) {
  const auto message = [](const std::string& bytes) {
    return error_of([&] { parse_pcd(bytes, "a.pcd"); });
  };
  for (const std::string& good : {pcd_ascii(), pcd_binary(), pcd_compressed()}) {
    EXPECT_NE(message(with(good, "POINTS 3", "POINTS 4")).find("must be equal"), good.npos);
    const std::string more =
        with(with(good, "POINTS 3", "POINTS 9999999999"), "WIDTH 3", "WIDTH 9999999999");
    EXPECT_NE(message(more).find("9999999999 points"), good.npos);
    EXPECT_NE(message(with(good, "WIDTH 3\nHEIGHT 1", "WIDTH 9999999999999\nHEIGHT 9999999999999"))
                  .find("too large"),
              good.npos);
    EXPECT_NE(message(with(good, "FIELDS x", "FIELDS w")).find("no field x"), good.npos);
    EXPECT_NE(message(with(good, "SIZE 4 1 8", "SIZE 4 1 3")).find("field y"), good.npos);
    EXPECT_NE(message(with(good, "COUNT 1 3", "COUNT 1 0")).find("COUNT 0"), good.npos);
    EXPECT_NE(message(with(good, "DATA", "DATE")).find("no line DATA"), good.npos);
  }
}

// How many cut files pass: text may be cut within the last number.
TEST(PcdReader, SurvivesDamage) {
  const auto parse = [](const std::string& bytes) { parse_pcd(bytes, "a.pcd"); };
  EXPECT_EQ(read_damaged(pcd_ascii(), parse), 8);  // 99000000 has eight digits
  EXPECT_EQ(read_damaged(pcd_binary(), parse), 0);
  EXPECT_EQ(read_damaged(pcd_compressed(), parse), 0);
}

TEST(PlyReader, ReadsAllFormatsAndSkipsElementsBeforeTheVertices) {
  const TemporaryFolder folder;
  for (const std::string& bytes : {ply_ascii(), ply_binary(false), ply_binary(true)})
    expect_three_points(read_ply(folder.write("a.ply", bytes)));
}

TEST(PlyReader, RefusesHeadersThatLie) {
  const auto message = [](const std::string& bytes) {
    return error_of([&] { parse_ply(bytes, "a.ply"); });
  };
  for (const std::string& good : {ply_ascii(), ply_binary(false), ply_binary(true)}) {
    const std::string none;
    EXPECT_NE(message(with(good, "vertex 3", "vertex 999999999999")).find("999999999999"),
              none.npos);
    EXPECT_NE(message(with(good, "face 2", "face 999999999999")).find("face"), none.npos);
    EXPECT_NE(message(with(good, "float x", "float w")).find("no field x"), none.npos);
    EXPECT_NE(message(with(good, "double y", "long y")).find("long"), none.npos);
    EXPECT_NE(message(with(good, "double y", "list uchar int y")).find("no lists"), none.npos);
    EXPECT_NE(message(with(good, "element vertex", "element points")).find("no element vertex"),
              none.npos);
  }
}

// Found by the fuzzer under UndefinedBehaviorSanitizer: columns of no rows need an address too.
TEST(PlyReader, ReadsFilesWithoutPoints) {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string bytes = "ply\nformat " + std::string(format) +
                              " 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                              "property float z\nend_header\n";
    EXPECT_EQ(parse_ply(bytes, "a.ply").scan.size(), 0U) << format;
  }
}

TEST(PlyReader, SurvivesDamage) {
  const auto parse = [](const std::string& bytes) { parse_ply(bytes, "a.ply"); };
  EXPECT_EQ(read_damaged(ply_ascii(), parse), 10);  // and the element behind the vertices
  EXPECT_EQ(read_damaged(ply_binary(false), parse), 1);
  EXPECT_EQ(read_damaged(ply_binary(true), parse), 1);
}

TEST(BinReader, ReadsPointsWithIntensity) {
  const TemporaryFolder folder;
  std::string bytes;
  for (const float value : {1.0F, 2.0F, 3.0F, 0.5F, kNan, 0.0F, -1.0F, 0.25F}) append(bytes, value);
  const Scan scan = read_bin(folder.write("a.bin", bytes));
  ASSERT_EQ(scan.size(), 2U);
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(std::isnan(scan.points[1].x()));
  EXPECT_EQ(scan.intensity, (std::vector<float>{0.5F, 0.25F}));
}

TEST(BinReader, TakesAnEmptyFileForAnEmptyScanAndRefusesACutOne) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_bin(folder.write("empty.bin", "")).size(), 0U);
  const auto cut = folder.write("cut.bin", std::string(33, '\0'));
  const std::string message = error_of([&] { read_bin(cut); });
  EXPECT_NE(message.find(cut.string() + " has 33 bytes"), message.npos);
  const std::string missing = error_of([&] { read_bin(folder.path() / "none.bin"); });
  EXPECT_NE(missing.find("none.bin cannot be read"), missing.npos);
}

TEST(Lzf, RepeatsWhatReferencesPointAt) {
  // "abc", then 9 bytes from 3 back (length byte 7 + 0 + 2), then 3 bytes from 12 back.
  const std::string packed = {'\2', 'a', 'b', 'c', '\xE0', '\0', '\2', '\x20', '\x0B'};
  EXPECT_EQ(decompress_lzf(packed, 15), "abcabcabcabcabc");
}

TEST(Lzf, RefusesDamagedData) {
  using namespace std::string_view_literals;
  EXPECT_FALSE(decompress_lzf("\2ab"sv, 3));               // literals cut off
  EXPECT_FALSE(decompress_lzf("\x20\0"sv, 3));             // refers to before the beginning
  EXPECT_FALSE(decompress_lzf("\0a\xE0"sv, 10));           // length cut off
  EXPECT_FALSE(decompress_lzf("\0a\x20"sv, 4));            // distance cut off
  EXPECT_FALSE(decompress_lzf("\2abc"sv, 2));              // makes more than asked for
  EXPECT_FALSE(decompress_lzf("\2abc"sv, 4));              // makes less
  EXPECT_FALSE(decompress_lzf("\2abc"sv, 4'000'000'000));  // cannot make this much
}

TEST(CloudWriter, WritesWhatTheReadersRead) {
  const TemporaryFolder folder;
  const std::vector<MapPoint> points = {{{1, 2, 3}, 0.5F, 0}, {{-1.25F, 1e6F, 0}, 255, 70000}};
  CloudFile pcd(folder.path() / "map.pcd", CloudFormat::pcd);
  pcd.add({points.data(), 1});
  pcd.add({points.data() + 1, 1});
  pcd.commit();
  write_ply(folder.path() / "map.ply", points);
  for (const RawScan& raw :
       {read_pcd(folder.path() / "map.pcd"), read_ply(folder.path() / "map.ply")}) {
    ASSERT_EQ(raw.scan.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(raw.scan.points[i], points[i].position);
      EXPECT_EQ(raw.scan.intensity[i], points[i].intensity);
    }
  }
}

}  // namespace
}  // namespace lego_loam_sc
