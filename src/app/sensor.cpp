// SPDX-License-Identifier: BSD-3-Clause
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/commands.hpp"
#include "app/scan_input.hpp"
#include "app/scan_prefetcher.hpp"
#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/sensor_presets.hpp"
#include "io/sensor_yaml.hpp"
#include "sensor/learn_sensor.hpp"

namespace lego_loam_sc {
namespace {

struct Options : InputOptions {
  std::optional<std::filesystem::path> output;
  std::size_t count = 50;
};

std::vector<Scan> read_scans(const Options& options) {
  ScanInput input(options, false);
  std::vector<Scan> scans;
  for (std::size_t k = 0; k < options.first + options.count; ++k) {
    std::optional<ScanOrFault> item = read_next(input.source());
    if (!item) break;
    if (const auto* fault = std::get_if<std::string>(&*item))
      spdlog::error("{}", *fault);
    else if (k >= options.first)
      scans.push_back(std::move(std::get<Scan>(*item)));
  }
  for (const std::string& note : input.source().notes()) spdlog::info("{}", note);
  input.wait_for_reader();
  if (scans.empty()) throw InputError(options.input + ": no scan could be read");
  return scans;
}

void learn(const Options& options) {
  const std::vector<Scan> scans = read_scans(options);
  LearnedSensor learned;
  try {
    learned = learn_sensor(scans, sensor_presets());
  } catch (const InputError& error) {
    throw InputError(options.input + ": " + error.what());
  }
  learned.sensor.name =
      "learned from " + std::to_string(scans.size()) + " scans of " + options.input;
  for (const std::string& note : learned.notes) spdlog::info("{}", note);
  if (options.output)
    write_file(*options.output, to_yaml(learned.sensor));
  else
    std::cout << to_yaml(learned.sensor);
}

}  // namespace

void add_sensor(CLI::App& app) {
  auto* command = app.add_subcommand(
      "sensor", "Learn the sensor that made some scans and print it as a file for --sensor");
  auto options = std::make_shared<Options>();
  add_input_options(*command, *options, "SCANS", "anything that run takes");
  command->add_option("-o,--output", options->output, "file to write instead of printing");
  command->add_option("--count", options->count, "number of scans to use")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->callback([options] { learn(*options); });
}

}  // namespace lego_loam_sc
