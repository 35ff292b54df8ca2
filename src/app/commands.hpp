// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace lego_loam_sc {

// Each registers its subcommand; parsing the command line runs it. They throw InputError.

/// `exit_code` becomes 1 when the results are there, but the input was not whole or the page of
/// them could not be made.
void add_run(CLI::App& app, int& exit_code);
void add_inspect(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app);
void add_match(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_config(CLI::App& app);
void add_sensor(CLI::App& app);

}  // namespace lego_loam_sc
