// SPDX-License-Identifier: BSD-3-Clause
#include "app/external_command.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>

namespace lego_loam_sc {

bool is_known_verb(const CLI::App& app, const std::string& word) {
  if (word.empty() || word.front() == '-' || word.find('/') != word.npos) return true;
  return !app.get_subcommands([&](const CLI::App* sub) { return sub->check_name(word); }).empty();
}

void run_external(char** argv) {
  char* const verb = argv[1];
  const std::string program = std::string("lego-loam-sc-") + verb;
  argv[1] = const_cast<char*>(program.c_str());  // execvp takes it by its C signature
  execvp(program.c_str(), argv + 1);
  argv[1] = verb;
}

}  // namespace lego_loam_sc
