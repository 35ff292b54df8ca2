// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <optional>
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

/// Runs the companion package's lego-loam-sc-report on the folder of a run and waits for it; false
/// when it failed and said why. Throws InputError when it is not installed.
bool make_report(const std::string& folder, bool quiet);

/// True for a bag or a capture by its name, and for the folder of a ROS 2 bag: what the companion
/// package reads.
bool is_recording(const std::string& input);

/// The companion package's reader at work: its scan stream takes the place of standard input.
class RecordingReader {
 public:
  /// Starts it; its messages go to standard error. Throws InputError when it is not installed.
  RecordingReader(const std::string& input, const std::optional<std::string>& topic, bool quiet);

  /// Ends the stream and waits for the program: 0 when all was well, 1 when it found a fault and
  /// said so, another number when it broke off. To be called once.
  int wait();

 private:
  pid_t process_ = -1;
};

}  // namespace lego_loam_sc
