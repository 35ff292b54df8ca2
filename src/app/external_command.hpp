// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace lego_loam_sc {

/// True for a subcommand of `app` and for anything that is no verb.
bool is_known_verb(const CLI::App& app, const std::string& word);

/// Replaces this process by lego-loam-sc-VERB with the arguments behind the verb, as git does. The
/// program is looked for beside this one, in the virtual environment of the checkout that this one
/// was built in, and in PATH. Returns only when there is none.
void run_external(char** argv);

/// Runs the companion package's lego-loam-sc-report on what run or inspect left and waits for it;
/// false when it failed and said why. Throws InputError when it is not installed.
bool make_report(const std::string& folder, bool quiet);

}  // namespace lego_loam_sc
