// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/health_log.hpp"
#include "core/sensor_model.hpp"
#include "core/settings.hpp"
#include "io/append_file.hpp"
#include "io/dataset_facts.hpp"
#include "io/trajectory.hpp"
#include "slam/report.hpp"
#include "slam/slam.hpp"

namespace lego_loam_sc {

struct NamedTruth {
  std::string file;
  PoseFile poses;
};

/// What `summary.json` says of the run besides what the SLAM knows.
struct RunFacts {
  std::string input;
  std::string method;
  std::string sensor;
  int threads = 1;
  double wall_seconds = 0.0;
  bool interrupted = false;
  std::vector<std::string> faults;  ///< of the input, a sentence each
  std::optional<NamedTruth> truth;
};

/// Writes the folder of a run: scans.csv, loops.csv and odometry.tum as results come, the rest at
/// the end. docs/output.md lists the columns.
class ResultWriter {
 public:
  ResultWriter(std::filesystem::path folder, const SensorModel& sensor, const Settings& settings);

  /// Begins the files; what a killed run has left of them goes. A state that is read goes on with
  /// them instead.
  void begin();

  void add(const ScanReport& report);

  /// Writes the files that need the whole run. Returns the summary as text for the terminal. Throws
  /// InputError when a file cannot be written and, after all are, when the truth is of another
  /// recording.
  std::string finish(const Slam& slam, const DatasetFacts& dataset, const RunFacts& facts);

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(scans_, loops_, odometry_, health_, loop_key_frames_, scan_count_, accepted_loops_,
            refused_loops_, statuses_, stamp_jumps_, first_jump_);
  }

 private:
  std::filesystem::path folder_;
  SensorModel sensor_;
  Settings settings_;
  HealthLog health_;
  AppendFile scans_;
  AppendFile loops_;
  AppendFile odometry_;
  std::set<int> loop_key_frames_;  ///< of accepted loops
  std::size_t scan_count_ = 0;
  std::size_t accepted_loops_ = 0;
  std::size_t refused_loops_ = 0;
  std::map<std::string, std::size_t> statuses_;
  std::size_t stamp_jumps_ = 0;
  std::string first_jump_;
};

}  // namespace lego_loam_sc
