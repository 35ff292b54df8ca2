// SPDX-License-Identifier: BSD-3-Clause
#include "app/scan_prefetcher.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <string>
#include <variant>

#include "app/interrupt.hpp"
#include "core/error.hpp"

namespace lego_loam_sc {
namespace {

class MadeSource : public ScanSource {
 public:
  using Make = std::function<std::optional<Scan>(int call)>;
  explicit MadeSource(Make make) : make_(std::move(make)) {}
  std::optional<Scan> next() override { return make_(calls++); }

  std::atomic<int> calls = 0;

 private:
  Make make_;
};

Scan scan_at(int stamp) {
  Scan scan;
  scan.stamp_ns = stamp;
  return scan;
}

// A driver that has gone quiet: waits for a byte that nobody sends, until a signal ends the wait.
std::optional<Scan> wait_for_nothing() {
  int ends[2];
  char byte = 0;
  if (pipe(ends) != 0) std::abort();
  EXPECT_LT(read(ends[0], &byte, 1), 0);
  close(ends[0]);
  close(ends[1]);
  return std::nullopt;
}

TEST(ScanPrefetcher, GivesScansAndFaultsInTheirOrder) {
  constexpr int kCalls = 40;
  MadeSource source([](int call) -> std::optional<Scan> {
    if (call == kCalls) return std::nullopt;
    if (call % 5 == 3) throw InputError("fault " + std::to_string(call));
    return scan_at(call);
  });
  ScanPrefetcher prefetcher(source);
  for (int call = 0; call < kCalls; ++call) {
    const std::optional<ScanOrFault> item = prefetcher.next();
    ASSERT_TRUE(item) << call;
    if (call % 5 == 3)
      EXPECT_EQ(std::get<std::string>(*item), "fault " + std::to_string(call));
    else
      EXPECT_EQ(std::get<Scan>(*item).stamp_ns, call);
  }
  EXPECT_FALSE(prefetcher.next());
  EXPECT_FALSE(prefetcher.next());
}

TEST(ScanPrefetcher, ReadsAheadAFewAndNoMore) {
  constexpr int kFew = 5;  // four that wait and one that was just read
  MadeSource source([](int call) { return scan_at(call); });
  {
    ScanPrefetcher prefetcher(source);
    while (source.calls < kFew) usleep(1000);
  }
  EXPECT_EQ(source.calls, kFew);
}

TEST(ScanPrefetcher, EndsThoughTheReaderWaitsForEver) {
  MadeSource source([](int call) { return call < 2 ? scan_at(call) : wait_for_nothing(); });
  ScanPrefetcher prefetcher(source);
  EXPECT_TRUE(prefetcher.next());
}

// Whichever thread the signal comes to. In a process of its own, for it stays interrupted.
TEST(ScanPrefetcher, AnInterruptEndsTheWaitForAReaderThatWaitsForEver) {
  const auto read_until_interrupted = [] {
    catch_interrupts();
    MadeSource source([](int) {
      raise(SIGINT);
      return wait_for_nothing();
    });
    ScanPrefetcher prefetcher(source);
    return !prefetcher.next() && interrupted();
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // it has a thread to begin
  EXPECT_EXIT(std::exit(read_until_interrupted() ? 0 : 1), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace lego_loam_sc
