// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "core/error.hpp"
#include "eval/association.hpp"
#include "eval/error_report.hpp"
#include "eval/errors.hpp"
#include "io/trajectory.hpp"

namespace lego_loam_sc {
namespace {

struct Options {
  std::string truth;
  std::vector<std::string> estimates;
  bool json = false;
};

TrajectoryError evaluate_file(const PoseFile& truth, const std::string& path) {
  const PoseFile estimate = read_poses(path);
  try {
    return evaluate(associate(truth, estimate));
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

void run_evaluate(const Options& options) {
  const PoseFile truth = read_poses(options.truth);
  std::vector<NamedError> estimates;
  for (const std::string& path : options.estimates)
    estimates.push_back({path, evaluate_file(truth, path)});
  if (!options.json) {
    std::cout << error_table(estimates);
    return;
  }
  auto list = nlohmann::ordered_json::array();
  for (const NamedError& estimate : estimates) {
    nlohmann::ordered_json entry = {{"estimate", estimate.name}};
    entry.update(to_json(estimate.error));
    list.push_back(entry);
  }
  std::cout << list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

}  // namespace

void add_evaluate(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("evaluate", "Compare trajectories with the truth: ATE, RPE, KITTI errors");
  const auto options = std::make_shared<Options>();
  command->add_option("TRUTH", options->truth, "true trajectory, TUM or KITTI format")->required();
  command->add_option("ESTIMATE", options->estimates, "estimated trajectories, TUM or KITTI format")
      ->required();
  command->add_flag("--json", options->json, "print JSON, one entry for each estimate");
  command->callback([options] { run_evaluate(*options); });
}

}  // namespace lego_loam_sc
