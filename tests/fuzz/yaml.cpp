// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz.hpp"
#include "io/dataset_facts.hpp"
#include "io/sensor_yaml.hpp"
#include "io/settings_yaml.hpp"

using namespace lego_loam_sc;

// Settings, sensor and dataset.yaml: what is accepted reads the same when it is printed.
int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string text = text_of(data, size);
  read_or_refuse([&] {
    Settings settings;
    apply_settings_yaml(text, "file", settings);
    const std::string printed = to_yaml(settings);
    Settings again;
    apply_settings_yaml(printed, "copy", again);
    require(to_yaml(again) == printed);
  });
  read_or_refuse([&] {
    const std::string printed = to_yaml(parse_sensor_yaml(text, "name", "file"));
    require(to_yaml(parse_sensor_yaml(printed, "name", "copy")) == printed);
  });
  read_or_refuse([&] {
    const std::string printed = to_yaml(parse_dataset_yaml(text, "file"));
    require(to_yaml(parse_dataset_yaml(printed, "copy")) == printed);
  });
  return 0;
}
