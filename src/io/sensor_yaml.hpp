// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/sensor_model.hpp"

namespace lego_loam_sc {

/// Loads a preset of config/sensors by its name, or else a YAML file of the same form; the model is
/// named after the preset or the file. Keys are fields of SensorModel and optional, except the
/// beams: either `elevation_deg` as a list, or `beams`, `lowest_deg` and `highest_deg` when they
/// are evenly spaced. Throws InputError when there is neither preset nor file, and with file and
/// line when a key or value is invalid.
SensorModel load_sensor(const std::string& name_or_file);

/// The same for the text of a file, which `file` names in messages.
SensorModel parse_sensor_yaml(const std::string& text, const std::string& name,
                              const std::string& file);

/// The sensor as YAML with a comment per field, for load_sensor.
std::string to_yaml(const SensorModel& sensor);

}  // namespace lego_loam_sc
