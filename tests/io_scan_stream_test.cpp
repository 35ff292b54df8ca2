// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "io/bytes.hpp"
#include "io/scan_stream.hpp"
#include "io_test_files.hpp"

namespace lego_loam_sc {
namespace {

Scan make_scan(std::int64_t stamp_ns, bool with_arrays) {
  Scan scan;
  scan.stamp_ns = stamp_ns;
  scan.points = {{1, 2, 3}, {-4, 5.5F, 0}};
  if (with_arrays) {
    scan.intensity = {7, 8};
    scan.ring = {0, 65535};
    scan.offset_ns = {-50'000'000, 50'000'000};
  }
  return scan;
}

std::string make_stream() {
  std::ostringstream out;
  DatasetFacts facts;
  facts.sensor = "vlp16";
  facts.motion_compensated = false;
  ScanStreamWriter writer(out, facts);
  writer.write(make_scan(1'595'444'159'265'510'001, true));
  writer.write(make_scan(-5, false));
  writer.write(Scan{});
  return out.str();
}

std::vector<Scan> read_all(ScanStreamReader& reader) {
  std::vector<Scan> scans;
  while (auto scan = reader.next()) scans.push_back(std::move(*scan));
  return scans;
}

TEST(ScanStream, GivesBackWhatWasWritten) {
  std::istringstream in(make_stream());
  ScanStreamReader reader(in, "stream");
  EXPECT_EQ(reader.facts().sensor, "vlp16");
  EXPECT_EQ(reader.facts().motion_compensated, false);
  const std::vector<Scan> scans = read_all(reader);
  ASSERT_EQ(scans.size(), 3U);
  const Scan first = make_scan(1'595'444'159'265'510'001, true);
  EXPECT_EQ(scans[0].stamp_ns, first.stamp_ns);
  EXPECT_EQ(scans[0].points, first.points);
  EXPECT_EQ(scans[0].intensity, first.intensity);
  EXPECT_EQ(scans[0].ring, first.ring);
  EXPECT_EQ(scans[0].offset_ns, first.offset_ns);
  EXPECT_EQ(scans[1].stamp_ns, -5);
  EXPECT_EQ(scans[1].points, first.points);
  EXPECT_TRUE(scans[1].intensity.empty() && scans[1].ring.empty() && scans[1].offset_ns.empty());
  EXPECT_EQ(scans[2].size(), 0U);
}

TEST(ScanStream, HasTheBytesThatTheDocumentationSays) {
  std::string bytes = "LLSCSCAN";
  append(bytes, std::uint32_t{1});
  append(bytes, std::uint32_t{0});
  bytes += "SCAN";
  append(bytes, std::uint32_t{2});
  append(bytes, std::int64_t{42});
  append(bytes, std::uint32_t{1});
  for (const float value : {1.0F, 2.0F, 3.0F}) append(bytes, value);
  append(bytes, std::uint16_t{9});
  std::ostringstream out;
  Scan scan;
  scan.stamp_ns = 42;
  scan.points = {{1, 2, 3}};
  scan.ring = {9};
  ScanStreamWriter(out).write(scan);
  EXPECT_EQ(out.str(), bytes);
}

TEST(ScanStream, ReturnsTheWholeScansOfACutStreamAndThenSaysWhereItWasCut) {
  std::string bytes = make_stream();
  bytes.resize(bytes.size() - 21);  // the third scan is 20 bytes: one byte of the second is missing
  std::istringstream in(bytes);
  ScanStreamReader reader(in, "stream");
  EXPECT_TRUE(reader.next());
  EXPECT_EQ(error_of([&] { reader.next(); }),
            "stream: it is truncated; 1 scans were complete, the error is at byte " +
                std::to_string(bytes.size()));
  EXPECT_FALSE(reader.next());
}

TEST(ScanStream, DoesNotAllocateWhatAHeaderPromises) {
  std::ostringstream out;
  ScanStreamWriter writer(out);
  std::string head = "SCAN";
  append(head, std::uint32_t{7});
  append(head, std::int64_t{0});
  const auto message = [&](std::uint32_t count) {
    std::string bytes = out.str() + head;
    append(bytes, count);
    std::istringstream in(bytes);
    ScanStreamReader reader(in, "stream");
    return error_of([&] { reader.next(); });
  };
  EXPECT_NE(message(10'000'001).find("10000001 points"), std::string::npos);
  EXPECT_NE(message(10'000'000).find("truncated"), std::string::npos);
}

TEST(ScanStream, RefusesAnotherVersionAndOtherFiles) {
  std::string bytes = make_stream();
  bytes[8] = 2;
  std::istringstream newer(bytes);
  const std::string version = error_of([&] { ScanStreamReader(newer, "stream"); });
  EXPECT_NE(version.find("version 2"), version.npos);
  std::istringstream other("# .PCD v0.7 - Point Cloud Data file format");
  const std::string magic = error_of([&] { ScanStreamReader(other, "stream"); });
  EXPECT_NE(magic.find("not a scan stream"), magic.npos);
}

TEST(ScanStream, RefusesToWriteArraysOfDifferentLengths) {
  std::ostringstream out;
  ScanStreamWriter writer(out);
  Scan scan = make_scan(0, true);
  scan.ring.pop_back();
  EXPECT_THROW(writer.write(scan), InputError);
}

TEST(ScanStream, SurvivesDamage) {
  const int accepted = read_damaged(make_stream(), [](const std::string& bytes) {
    std::istringstream in(bytes);
    ScanStreamReader reader(in, "stream");
    read_all(reader);
  });
  EXPECT_EQ(accepted, 3);  // cut off exactly before the first, second or third scan
}

}  // namespace
}  // namespace lego_loam_sc
