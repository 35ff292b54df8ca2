// SPDX-License-Identifier: BSD-3-Clause
#include "io/sensor_presets.hpp"

#include <string>

#include "io/presets.hpp"
#include "io/sensor_yaml.hpp"
#include "sensor/recognise_sensor.hpp"

namespace lego_loam_sc {

std::vector<SensorModel> sensor_presets() {
  std::vector<SensorModel> presets;
  for (const std::string& name : preset_names("sensors")) presets.push_back(load_sensor(name));
  return presets;
}

SensorModel recognise_sensor(const Scan& scan, const DatasetFacts& facts) {
  return with_facts(
      facts.sensor ? load_sensor(*facts.sensor) : recognise_sensor(scan, sensor_presets()), facts);
}

}  // namespace lego_loam_sc
