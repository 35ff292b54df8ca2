// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace lego_loam_sc {

/// A file of config/, compiled in.
struct Preset {
  std::string_view kind;  ///< folder: "sensors" or "methods"
  std::string_view name;  ///< file name without extension
  std::string_view text;  ///< YAML
};

/// All presets, by kind and name. cmake/EmbedPresets.cmake writes the definition.
std::span<const Preset> presets();

}  // namespace lego_loam_sc
