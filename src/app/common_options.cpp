// SPDX-License-Identifier: BSD-3-Clause
#include "app/common_options.hpp"

#include <CLI/CLI.hpp>

#include "io/sensor_presets.hpp"
#include "io/sensor_yaml.hpp"

namespace lego_loam_sc {

void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--sensor", options.sensor, "sensor preset or YAML file");
  command
      .add_option("--method", options.method,
                  "settings preset: lego-loam-sc, lego-loam-sc-paper, lego-loam, loam")
      ->capture_default_str();
  command.add_option("--config", options.config, "YAML file with settings");
  command.add_option("--set", options.assignments, "one setting, key=value; may be repeated")
      ->allow_extra_args(false);
}

SensorModel choose_sensor(const std::optional<std::string>& asked, const Scan& scan,
                          const DatasetFacts& facts) {
  return asked ? with_facts(load_sensor(*asked), facts) : recognise_sensor(scan, facts);
}

}  // namespace lego_loam_sc
