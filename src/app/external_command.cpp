// SPDX-License-Identifier: BSD-3-Clause
#include "app/external_command.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

#include "app/companion.hpp"
#include "core/error.hpp"

namespace lego_loam_sc {

bool is_known_verb(const CLI::App& app, const std::string& word) {
  if (word.empty() || word.front() == '-' || word.find('/') != word.npos) return true;
  return !app.get_subcommands([&](const CLI::App* sub) { return sub->check_name(word); }).empty();
}

void run_external(char** argv) {
  char* const verb = argv[1];
  std::string program = find_program(std::string("lego-loam-sc-") + verb);
  argv[1] = program.data();
  execvp(program.c_str(), argv + 1);
  argv[1] = verb;
}

bool make_report(const std::string& folder, bool quiet) {
  std::fflush(stdout);  // what was said before comes before
  std::vector<std::string> arguments;
  if (quiet) arguments.emplace_back("--quiet");
  arguments.insert(arguments.end(), {"--", folder});
  pid_t process = -1;
  const int error =
      start_program(find_program("lego-loam-sc-report"), std::move(arguments), process);
  if (error != 0)
    throw InputError(folder + " is complete but for the report: it is made " +
                     explain_no_start("lego-loam-sc-report", error) +
                     ", and call lego-loam-sc report " + folder);
  return wait_for(process) == 0;
}

}  // namespace lego_loam_sc
