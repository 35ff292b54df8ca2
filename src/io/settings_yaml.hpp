// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slam/settings.hpp"

namespace lego_loam_sc {

/// Loads the settings of a method (a preset of config/methods), overridden by a YAML file and then
/// by assignments such as `loop.scan_context.threshold=0.3`. Throws InputError that names file,
/// line and the nearest key when a key does not exist, and the allowed values when a value is
/// invalid.
Settings load_settings(const std::string& method,
                       const std::optional<std::filesystem::path>& config_file,
                       const std::vector<std::string>& assignments);

/// Applies the settings in the text of a YAML file, which `file` names in messages.
void apply_settings_yaml(const std::string& text, const std::string& file, Settings& settings);

/// All settings as YAML with a comment each, for load_settings.
std::string to_yaml(const Settings& settings);

}  // namespace lego_loam_sc
