// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace lego_loam_sc {

/// True for a bag or a capture by its name, and for the folder of a ROS 2 bag: what the companion
/// package reads.
bool is_recording(const std::string& input);

/// A running lego-loam-sc-read, whose scan stream takes the place of standard input.
class RecordingReader {
 public:
  /// Starts it; its messages go to standard error. Throws InputError when it is not installed.
  RecordingReader(const std::string& input, const std::optional<std::string>& topic, bool quiet);

  /// Closes the stream and waits for the program: 0 on success, 1 when it printed a fault of the
  /// input, another number when it failed. To be called once.
  int wait();

 private:
  pid_t process_ = -1;
};

}  // namespace lego_loam_sc
