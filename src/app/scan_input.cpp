// SPDX-License-Identifier: BSD-3-Clause
#include "app/scan_input.hpp"

#include <CLI/CLI.hpp>

#include "core/error.hpp"

namespace lego_loam_sc {

void add_input_options(CLI::App& command, InputOptions& options, const std::string& name,
                       const std::string& help) {
  command.add_option(name, options.input, help)->required();
  command.add_option("--topic", options.topic, "topic of a bag, when several hold PointCloud2");
  command.add_option("--first", options.first, "number of the first scan to use, from 0");
}

ScanInput::ScanInput(const InputOptions& options, bool quiet) {
  if (is_recording(options.input))
    reader_.emplace(options.input, options.topic, quiet);
  else if (options.topic)
    throw InputError("--topic is for bags, " + options.input + " is none; leave it out");
  source_ = open_scans(reader_ ? "-" : options.input);
}

}  // namespace lego_loam_sc
