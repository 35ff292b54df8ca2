// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace lego_loam_sc {

/// True for a subcommand of `app` and for anything that is no verb.
bool is_known_verb(const CLI::App& app, const std::string& word);

/// Replaces this process by lego-loam-sc-VERB from PATH with the arguments behind the verb, as git
/// does. Returns only when there is no such program.
void run_external(char** argv);

}  // namespace lego_loam_sc
