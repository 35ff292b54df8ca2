// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lego_loam_sc {

/// A file of config/, compiled in.
struct Preset {
  std::string_view kind;  ///< folder: "sensors" or "methods"
  std::string_view name;  ///< file name without extension
  std::string_view text;  ///< YAML
};

/// All presets, by kind and name. cmake/EmbedPresets.cmake generates the definition.
std::span<const Preset> presets();

/// The names of the presets of a kind, "sensors" or "methods".
std::vector<std::string> preset_names(std::string_view kind);

/// The YAML of a preset, or nothing when there is none of this name.
std::optional<std::string> find_preset(std::string_view kind, std::string_view name);

/// "vlp61; the presets are hdl32e, vlp16 (vlp16 is the nearest)"
std::string describe_unknown(std::string_view kind, const std::string& name);

}  // namespace lego_loam_sc
