// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "io/sensor_yaml.hpp"
#include "io/settings_yaml.hpp"

namespace lego_loam_sc {

void add_config(CLI::App& app) {
  auto* command = app.add_subcommand("config", "Print the settings in force, with a comment each");
  auto options = std::make_shared<CommonOptions>();
  add_common_options(*command, *options);
  command->callback([options] {
    std::cout << to_yaml(load_settings(options->method, options->config, options->assignments));
    if (options->sensor)
      std::cout << "\n# sensor " << *options->sensor << "\n"
                << to_yaml(load_sensor(*options->sensor));
  });
}

}  // namespace lego_loam_sc
