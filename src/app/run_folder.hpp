// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace lego_loam_sc {

/// Makes the folder that a run writes to. A given one must be new or empty; without one it is
/// runs/<name>-<number>, numbered on, and runs/latest links to it. Throws InputError.
std::filesystem::path make_run_folder(const std::optional<std::filesystem::path>& asked,
                                      const std::string& input);

}  // namespace lego_loam_sc
