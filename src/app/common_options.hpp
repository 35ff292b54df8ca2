// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "io/dataset_facts.hpp"

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

/// The sensor that was asked for, with the facts applied, or else the one that `scan` shows. Throws
/// InputError when it cannot be told.
SensorModel choose_sensor(const std::optional<std::string>& asked, const Scan& scan,
                          const DatasetFacts& facts);

}  // namespace lego_loam_sc
