// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "app/health_log.hpp"
#include "app/run_facts.hpp"
#include "app/run_summary.hpp"
#include "core/sensor_model.hpp"
#include "io/append_file.hpp"
#include "io/dataset_facts.hpp"
#include "slam/report.hpp"
#include "slam/settings.hpp"
#include "slam/slam.hpp"

namespace lego_loam_sc {

/// Writes the folder of a run: scans.csv, loops.csv and odometry.tum as results come, the rest at
/// the end. docs/output.md lists the columns.
class ResultWriter {
 public:
  ResultWriter(std::filesystem::path folder, const SensorModel& sensor, const Settings& settings);

  /// Begins the files and drops what a killed run has left of them. A resumed run reads its state
  /// instead and appends.
  void begin();

  /// Writes the lines of the next scan.
  void add(const ScanReport& report);

  /// Writes the files that need the whole run. Returns the summary. Throws InputError when a file
  /// cannot be written or, after writing all, when the truth is of another
  /// recording.
  RunSummary finish(const Slam& slam, const DatasetFacts& dataset, const RunFacts& facts);

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(scans_, loops_, odometry_, health_, loop_key_frames_, counts_);
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
  RunCounts counts_;
};

}  // namespace lego_loam_sc
