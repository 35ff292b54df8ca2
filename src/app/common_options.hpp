// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lego_loam_sc {

/// What decides the settings and the sensor in every command that has them.
struct CommonOptions {
  std::string method = "lego-loam-sc";
  std::optional<std::filesystem::path> config;
  std::vector<std::string> assignments;
  std::optional<std::string> sensor;
};

void add_common_options(CLI::App& command, CommonOptions& options);

}  // namespace lego_loam_sc
