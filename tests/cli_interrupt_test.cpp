// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "cli_program.hpp"

namespace lego_loam_sc {
namespace {

constexpr int kScans = 8;

// The program with a pipe to its standard input that nobody closes: a driver that has gone quiet.
class StalledRun {
 public:
  StalledRun(const std::string& stream, const std::string& folder, const std::string& threads) {
    int ends[2];
    if (pipe(ends) != 0) std::abort();
    child_ = fork();
    if (child_ == 0) {
      dup2(ends[0], STDIN_FILENO);
      close(ends[0]);
      close(ends[1]);
      execl(LEGO_LOAM_SC_PROGRAM, LEGO_LOAM_SC_PROGRAM, "run", "-", "--quiet", "-o", folder.c_str(),
            "--threads", threads.c_str(), nullptr);
      _exit(127);
    }
    close(ends[0]);
    input_ = ends[1];
    for (std::size_t at = 0; at < stream.size();) {
      const ssize_t taken = write(input_, stream.data() + at, stream.size() - at);
      if (taken <= 0) break;
      at += static_cast<std::size_t>(taken);
    }
  }
  ~StalledRun() {
    close(input_);
    if (!ended_) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
  }
  StalledRun(const StalledRun&) = delete;
  StalledRun& operator=(const StalledRun&) = delete;

  void send(int number) const { kill(child_, number); }

  // The exit code; -1 when the program does not end by itself in good time or at all.
  int wait() {
    for (int glance = 0; glance < 3000 && !ended_; ++glance) {
      ended_ = waitpid(child_, &status_, WNOHANG) == child_;
      if (!ended_) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return ended_ && WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

 private:
  pid_t child_ = -1;
  int input_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

bool wait_for_lines(const std::filesystem::path& file, std::size_t count) {
  for (int glance = 0; glance < 3000; ++glance) {
    if (std::filesystem::exists(file) && lines_of(file).size() >= count) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

struct HowToEnd {
  int signal;
  const char* threads;
};

class Interrupt : public testing::TestWithParam<HowToEnd> {};

TEST_P(Interrupt, FinishesTheFilesForTheScansThatCameThoughTheStreamStaysOpen) {
  const Shell shell;
  shell.must("$P simulate parking --sensor rs16 -o - --count " + std::to_string(kScans) + " > all");
  const std::filesystem::path result = shell.folder() / "result";
  // The last scan stays incomplete, so that the program waits within it.
  const std::string stream = read_text(shell.folder() / "all");
  StalledRun run(stream.substr(0, stream.size() - 100), result, GetParam().threads);
  ASSERT_TRUE(wait_for_lines(result / "scans.csv", kScans));
  run.send(GetParam().signal);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(lines_of(result / "trajectory.tum").size(), kScans - 1U);
  const auto summary = nlohmann::json::parse(read_text(result / "summary.json"));
  EXPECT_EQ(summary["interrupted"], true);
  EXPECT_EQ(summary["scans"], kScans - 1);
  EXPECT_EQ(summary["faults"].size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(SignalsAndThreads, Interrupt,
                         testing::Values(HowToEnd{SIGINT, "1"}, HowToEnd{SIGINT, "2"},
                                         HowToEnd{SIGTERM, "1"}, HowToEnd{SIGTERM, "2"}));

TEST(Kill, LeavesWholeLinesAndNoFileThatLooksWhole) {
  const Shell shell;
  shell.must("$P simulate parking --sensor rs16 -o - --count " + std::to_string(kScans) + " > all");
  const std::filesystem::path result = shell.folder() / "result";
  const std::string stream = read_text(shell.folder() / "all");
  StalledRun run(stream.substr(0, stream.size() - 100), result, "2");
  ASSERT_TRUE(wait_for_lines(result / "scans.csv", kScans));
  run.send(SIGKILL);
  EXPECT_EQ(run.wait(), -1);
  const auto rows = read_csv(result / "scans.csv");
  ASSERT_EQ(rows.size(), std::size_t{kScans});
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  EXPECT_TRUE(read_text(result / "odometry.tum").ends_with("\n"));
  EXPECT_FALSE(std::filesystem::exists(result / "trajectory.tum"));
  EXPECT_FALSE(std::filesystem::exists(result / "summary.json"));
}

}  // namespace
}  // namespace lego_loam_sc
