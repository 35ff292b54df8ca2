// SPDX-License-Identifier: BSD-3-Clause
#include <malloc.h>
#include <signal.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>

#include "app/commands.hpp"
#include "app/external_command.hpp"
#include "core/error.hpp"

namespace {

constexpr int kBadInput = 1;
constexpr int kBadUsage = 2;

// Buffers of a few megabytes come and go with every scan: keep their memory instead of giving it
// back to the system and clearing it anew each time.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 16 << 20);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace lego_loam_sc;
  // Standard output is for results: a scan stream, JSON, settings.
  spdlog::set_default_logger(spdlog::stderr_color_mt("lego-loam-sc"));
  keep_freed_memory();
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like others
  spdlog::set_pattern("lego-loam-sc: %v");

  CLI::App app{"LiDAR-only SLAM: LeGO-LOAM with Scan Context loops."};
  app.set_version_flag("--version", LEGO_LOAM_SC_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  add_run(app, exit_code);
  add_simulate(app);
  add_match(app);
  add_evaluate(app);
  add_config(app);
  add_inspect(app, exit_code);
  add_sensor(app);
  app.footer("Any other verb runs lego-loam-sc-VERB from PATH.");

  if (argc > 1 && !is_known_verb(app, argv[1])) {
    run_external(argv);  // returns when there is none
    spdlog::error("there is no verb {0} and no program lego-loam-sc-{0} in PATH; see --help",
                  argv[1]);
    return kBadUsage;
  }
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadUsage;
  } catch (const InputError& error) {
    spdlog::error("{}", error.what());
  } catch (const std::bad_alloc&) {
    spdlog::error("there is not enough memory; process fewer scans with --count");
  } catch (const std::exception& error) {
    spdlog::error("internal error: {}", error.what());
  }
  return kBadInput;
}
