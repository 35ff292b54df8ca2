// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "app/health_log.hpp"
#include "app/run_facts.hpp"
#include "core/trajectory.hpp"
#include "io/dataset_facts.hpp"
#include "slam/slam.hpp"

namespace lego_loam_sc {

/// The summary of a run; docs/output.md explains the keys.
struct RunSummary {
  nlohmann::ordered_json json;  ///< content of summary.json
  std::string text;             ///< lines for the terminal
  std::string verdict;          ///< the last line
};

/// Summarises a run; `trajectory` is the corrected one. CPU time and memory are those of the
/// process so far.
RunSummary summarise(const Slam& slam, const Trajectory& trajectory, std::size_t map_points,
                     const RunCounts& counts, const HealthLog& health, const RunFacts& facts);

/// Adds the errors of a corrected trajectory and of the odometry against the truth. Throws
/// InputError, naming the file of the truth, when that is of another recording.
void add_errors(const NamedTruth& truth, const DatasetFacts& dataset, const Trajectory& odometry,
                const Trajectory& trajectory, RunSummary& summary);

}  // namespace lego_loam_sc
