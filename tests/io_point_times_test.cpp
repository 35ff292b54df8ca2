// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "io/point_times.hpp"
#include "io_test_files.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kStamp = 1'600'000'000'000'000'000;

PointTimes interpret(const std::vector<double>& times, const StampHint& hint = {kStamp, true, {}},
                     NumberType type = NumberType::float64) {
  return interpret_point_times(times, type, hint, "a.pcd");
}

using Offsets = std::vector<std::int32_t>;

TEST(PointTimes, TheSpanDecidesTheUnit) {
  const Offsets expected = {0, 50'000'000, 100'000'000};
  EXPECT_EQ(interpret({0, 0.05, 0.1}).offset_ns, expected);
  EXPECT_EQ(interpret({0, 50, 100}).offset_ns, expected);
  EXPECT_EQ(interpret({0, 5e4, 1e5}).offset_ns, expected);
  EXPECT_EQ(interpret({0, 5e7, 1e8}).offset_ns, expected);
  EXPECT_EQ(interpret({0, 5e7, 1e8}).stamp_ns, kStamp);
}

// The cases that the reader of recordings is tested with too.
TEST(PointTimes, FollowTheRulesThatBothReadersShare) {
  const std::map<std::string, NumberType> types = {
      {"uint16", NumberType::uint16},   {"uint32", NumberType::uint32},
      {"int64", NumberType::int64},     {"uint64", NumberType::uint64},
      {"float32", NumberType::float32}, {"float64", NumberType::float64}};
  const std::vector<std::string> units = {"s", "ms", "us", "ns"};
  std::ifstream file(std::string(LEGO_LOAM_SC_SOURCE) + "/tests/point_times_cases.txt");
  int cases = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    SCOPED_TRACE(line);
    // Columns are two blanks apart, the numbers of one column are one.
    std::vector<std::string> columns;
    for (std::size_t at = 0; at != line.npos; at = line.find_first_not_of(' ', at)) {
      const std::size_t end = line.find("  ", at);
      columns.push_back(line.substr(at, end == line.npos ? end : end - at));
      at = end;
    }
    ASSERT_EQ(columns.size(), 5U);
    StampHint hint{std::stoll(columns[1]), true, {}};
    const auto unit = std::find(units.begin(), units.end(), columns[2]);
    if (unit != units.end()) hint.unit = static_cast<TimeUnit>(unit - units.begin());
    std::vector<double> times;
    std::istringstream words(columns[3]);
    for (std::string word; words >> word;) times.push_back(std::stod(word));
    const auto interpreted = [&] { return interpret(times, hint, types.at(columns[0])); };
    ++cases;
    if (columns[4] == "refused") {
      EXPECT_THROW(interpreted(), InputError);
      continue;
    }
    const Offsets found = interpreted().offset_ns;
    Offsets expected;
    std::istringstream numbers(columns[4]);
    for (std::int32_t number; numbers >> number;) expected.push_back(number);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 256);  // what a double of nanoseconds since 1970 resolves
  }
  EXPECT_GT(cases, 25);
}

TEST(PointTimes, RelativeTimesMayLieBeforeTheStamp) {
  EXPECT_EQ(interpret({-0.1, 0}).offset_ns, (Offsets{-100'000'000, 0}));
}

TEST(PointTimes, AbsoluteTimesOfTheStampsClockCountFromTheStamp) {
  const PointTimes times =
      interpret({1.6e18 - 5e7, 1.6e18 + 5e7}, {kStamp, true, {}}, NumberType::uint64);
  EXPECT_EQ(times.stamp_ns, kStamp);
  ASSERT_EQ(times.offset_ns.size(), 2U);  // a double of this size is good to 256 ns
  EXPECT_NEAR(times.offset_ns[0], -50'000'000, 256);
  EXPECT_NEAR(times.offset_ns[1], 50'000'000, 256);
}

TEST(PointTimes, AbsoluteTimesOfAnotherClockCountFromTheFirst) {
  const PointTimes times = interpret({1234.6, 1234.5}, {7, true, {}});
  EXPECT_EQ(times.stamp_ns, 7);
  EXPECT_NEAR(times.offset_ns[0], 100'000'000, 1);
  EXPECT_EQ(times.offset_ns[1], 0);
}

TEST(PointTimes, AbsoluteTimesReplaceAStampThatWasMadeUp) {
  const PointTimes times = interpret({1.6e9 + 0.5, 1.6e9 + 0.625}, {0, false, {}});
  EXPECT_EQ(times.stamp_ns, kStamp + 500'000'000);
  EXPECT_EQ(times.offset_ns, (Offsets{0, 125'000'000}));
}

TEST(PointTimes, EqualOrMissingTimesAreNone) {
  EXPECT_TRUE(interpret({}).offset_ns.empty());
  EXPECT_TRUE(interpret({0, 0, 0}).offset_ns.empty());
  EXPECT_TRUE(interpret({kNan, 5.0}).offset_ns.empty());
}

TEST(PointTimes, PointsWithoutReturnDoNotCount) {
  EXPECT_EQ(interpret({kNan, 0.02, 0.1}).offset_ns, (Offsets{0, 20'000'000, 100'000'000}));
}

TEST(PointTimes, StrayTimesCostTheirPointsOnly) {
  std::vector<double> times(1000);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = 1.6e9 + 1e-4 * static_cast<double>(i);
  times[5] = 0.0;
  times[700] = 1.7e9;
  const PointTimes stray = interpret(times);
  EXPECT_EQ(stray.stray, (std::vector<std::uint32_t>{5, 700}));
  EXPECT_EQ(stray.unit, TimeUnit::seconds);
  EXPECT_NEAR(stray.offset_ns[999], 99'900'000, 256);
  EXPECT_EQ(stray.offset_ns[700], 0);
}

TEST(PointTimes, AScanWithManyStrayTimesIsRefused) {
  std::vector<double> times(1000);
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] = i % 10 == 0 ? 0.0 : 1.6e9 + 1e-4 * static_cast<double>(i);
  EXPECT_THROW(interpret(times), InputError);
}

TEST(PointTimes, AreOffsetsThatDiffer) {
  EXPECT_FALSE(are_times(Offsets{}));
  EXPECT_FALSE(are_times(Offsets{7, 7, 7}));
  EXPECT_TRUE(are_times(Offsets{7, 7, 8}));
}

TEST(PointTimes, AskForTheUnitWhenNoneFits) {
  const std::string message = error_of([] { interpret({0, 5}); });
  EXPECT_NE(message.find("a.pcd: the point times run from 0 to 5"), message.npos);
  EXPECT_NE(message.find("point_times"), message.npos);
  const std::string coarse =
      error_of([] { interpret({1.6e9, 1.6e9 + 128}, {kStamp, true, {}}, NumberType::float32); });
  EXPECT_NE(coarse.find("float32"), coarse.npos);
}

TEST(PointTimes, TheUnitCanBeGiven) {
  EXPECT_EQ(interpret({0, 5}, {0, true, TimeUnit::milliseconds}).offset_ns,
            (Offsets{0, 5'000'000}));
  EXPECT_TRUE(interpret({0, 5}, {0, true, TimeUnit::none}).offset_ns.empty());
  EXPECT_THROW(interpret({0, 5}, {0, true, TimeUnit::seconds}), InputError);
}

TEST(PointTimes, SaysWhatWasDecided) {
  EXPECT_EQ(interpret({0, 1e5}).decision,
            "the point times are microseconds relative to the stamp of the scan; a sweep runs "
            "from 0.0 to 100.0 ms after it");
  EXPECT_TRUE(
      interpret({-0.1, 0}).decision.ends_with("a sweep runs from -100.0 to 0.0 ms after it"));
}

TEST(PointTimes, NoNumbersOverflow) {
  const double huge = std::numeric_limits<double>::max();
  EXPECT_THROW(interpret({-huge, huge}), InputError);
  EXPECT_THROW(interpret({-huge, huge}, {0, true, TimeUnit::nanoseconds}), InputError);
  const PointTimes late = interpret({1e18, 1e18 + 128}, {0, false, TimeUnit::milliseconds});
  EXPECT_EQ(late.offset_ns, (Offsets{0, 128'000'000}));
  EXPECT_EQ(late.stamp_ns, 0);
}

}  // namespace
}  // namespace lego_loam_sc
