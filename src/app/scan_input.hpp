// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "app/recording_reader.hpp"
#include "io/scan_source.hpp"

namespace CLI {
class App;
}

namespace lego_loam_sc {

/// Where the scans of a command come from.
struct InputOptions {
  std::string input;
  std::optional<std::string> topic;
  std::size_t first = 0;  ///< number of the first scan to use; the command skips those before
};

/// Adds the positional `name` with its `help`, --topic and --first.
void add_input_options(CLI::App& command, InputOptions& options, const std::string& name,
                       const std::string& help);

/// A scan and what its input says of all scans.
struct ScanWithFacts {
  Scan scan;
  DatasetFacts facts;
};

/// The scans of an input, those of a recording through the companion package's reader.
class ScanInput {
 public:
  /// Throws InputError when the input cannot be opened. `quiet` is for the reader.
  ScanInput(const InputOptions& options, bool quiet);

  ScanSource& source() { return *source_; }
  const ScanSource& source() const { return *source_; }

  /// Ends the reader of a recording: its exit code, 0 when there is none. To be called once.
  int wait_for_reader() { return reader_ ? reader_->wait() : 0; }

 private:
  std::optional<RecordingReader> reader_;
  std::unique_ptr<ScanSource> source_;
};

}  // namespace lego_loam_sc
