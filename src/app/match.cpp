// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/scan_input.hpp"
#include "core/error.hpp"
#include "io/scan_source.hpp"
#include "io/settings_yaml.hpp"
#include "slam/match_scans.hpp"

namespace lego_loam_sc {
namespace {

struct Options {
  CommonOptions common;
  std::string a, b;
  bool json = false;
};

ScanWithFacts only_scan(const std::string& path) {
  const std::unique_ptr<ScanSource> source = open_scans(path);
  std::optional<Scan> scan = source->next();
  if (!scan) throw InputError(path + ": there is no scan in it; give one scan");
  return {std::move(*scan), source->facts()};
}

nlohmann::json to_json(const ScanMatch& match) {
  nlohmann::json rows = nlohmann::json::array();
  for (int r = 0; r < 4; ++r) {
    nlohmann::json row = nlohmann::json::array();
    for (int c = 0; c < 4; ++c) row.push_back(match.verification.T_match_query.matrix()(r, c));
    rows.push_back(row);
  }
  return {{"accepted", match.verification.verdict == Verdict::accepted},
          {"verdict", to_string(match.verification.verdict)},
          {"scan_context_distance", match.scan_context.distance},
          {"yaw_deg", degrees(match.scan_context.yaw)},
          {"overlap", match.verification.overlap},
          {"rmse_m", match.verification.rmse},
          {"T_a_b", rows}};
}

void print_text(const ScanMatch& match) {
  const LoopVerification& v = match.verification;
  std::printf("Scan Context   distance %.4f, yaw %.1f deg\n", match.scan_context.distance,
              degrees(match.scan_context.yaw));
  std::printf("verifier       %s, overlap %.2f, RMSE %.3f m\n", to_string(v.verdict).data(),
              v.overlap, v.rmse);
  std::printf("T_a_b (maps points of B into A)\n");
  for (int r = 0; r < 4; ++r)
    std::printf("  %12.9f %12.9f %12.9f %14.9f\n", v.T_match_query.matrix()(r, 0),
                v.T_match_query.matrix()(r, 1), v.T_match_query.matrix()(r, 2),
                v.T_match_query.matrix()(r, 3));
}

}  // namespace

void add_match(CLI::App& app) {
  auto* command = app.add_subcommand(
      "match", "Compare two scans as a loop candidate and find the transform between them");
  auto options = std::make_shared<Options>();
  command->add_option("A", options->a, "scan of the earlier visit")->required();
  command->add_option("B", options->b, "scan of the later visit")->required();
  add_common_options(*command, options->common);
  command->add_flag("--json", options->json, "print JSON");
  command->callback([options] {
    const CommonOptions& common = options->common;
    const Settings settings = load_settings(common.method, common.config, common.assignments);
    const ScanWithFacts a = only_scan(options->a);
    const ScanWithFacts b = only_scan(options->b);
    const SensorModel sensor = choose_sensor(common.sensor, a.scan, a.facts);
    const ScanMatch match = match_scans(a.scan, b.scan, sensor, settings);
    if (options->json) {
      std::cout << to_json(match).dump(2) << "\n";
    } else {
      print_text(match);
    }
  });
}

}  // namespace lego_loam_sc
