// SPDX-License-Identifier: BSD-3-Clause
#include "io/presets.hpp"

#include "core/text.hpp"

namespace lego_loam_sc {

std::vector<std::string> preset_names(std::string_view kind) {
  std::vector<std::string> names;
  for (const Preset& preset : presets())
    if (preset.kind == kind) names.emplace_back(preset.name);
  return names;
}

std::optional<std::string> find_preset(std::string_view kind, std::string_view name) {
  for (const Preset& preset : presets())
    if (preset.kind == kind && preset.name == name) return std::string(preset.text);
  return std::nullopt;
}

std::string describe_unknown(std::string_view kind, const std::string& name) {
  const std::vector<std::string> names = preset_names(kind);
  return name + "; the presets are " + join(names) + " (" + nearest_name(name, names) +
         " is the nearest)";
}

}  // namespace lego_loam_sc
