// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace lego_loam_sc {

/// Adds the subcommand `simulate`: scans of a made world with their exact truth. It runs within
/// `app.parse` and throws InputError when an argument is wrong or the output cannot be written.
void add_simulate(CLI::App& app);

}  // namespace lego_loam_sc
