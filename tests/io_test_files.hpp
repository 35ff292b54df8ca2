// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace lego_loam_sc {

/// An empty folder of the test's own, gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            ("lego_loam_sc_" + std::string(test->test_suite_name()) + "_" + test->name() + "_" +
             std::to_string(getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

 private:
  std::filesystem::path path_;
};

/// The message of the InputError that `action` throws; a failure of the test when it throws none.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return {};
}

/// Reads `bytes` cut off at every length and with random bytes changed: `read` may throw InputError
/// and nothing else. Returns how many of the cut ones were taken as good.
inline int read_damaged(const std::string& bytes,
                        const std::function<void(const std::string&)>& read) {
  int accepted = 0;
  const auto try_one = [&](const std::string& damaged) {
    try {
      read(damaged);
      return 1;
    } catch (const InputError& error) {
      EXPECT_FALSE(std::string_view(error.what()).empty());
      return 0;
    }
  };
  for (std::size_t size = 0; size < bytes.size(); ++size)
    accepted += try_one(bytes.substr(0, size));
  std::mt19937 random(7);
  for (int round = 0; round < 2000; ++round) {
    std::string damaged = bytes;
    for (int flips = 1 + round % 4; flips > 0; --flips)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    try_one(damaged);
  }
  return accepted;
}

}  // namespace lego_loam_sc
