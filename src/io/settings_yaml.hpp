// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slam/settings.hpp"

namespace lego_loam_sc {

/// The settings of a method (a preset of config/methods), changed by a YAML file and then by
/// assignments such as `loop.scan_context.threshold=0.3`. Throws InputError that names file, line
/// and the nearest key when a key does not exist, and what is allowed when a value is bad.
Settings load_settings(const std::string& method,
                       const std::optional<std::filesystem::path>& config_file,
                       const std::vector<std::string>& assignments);

/// Changes the settings that the text of a YAML file names; messages begin with `file`.
void apply_settings_yaml(const std::string& text, const std::string& file, Settings& settings);

/// All settings as YAML with a comment each; loaded again it gives the same settings.
std::string to_yaml(const Settings& settings);

}  // namespace lego_loam_sc
