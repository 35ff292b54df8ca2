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

/// A run in short, for programs and for people; docs/output.md explains the keys.
struct RunSummary {
  nlohmann::ordered_json json;  ///< content of summary.json
  std::string text;             ///< lines for the terminal
  std::string verdict;          ///< the last line
};

/// Says what came of a run: `trajectory` is the corrected one. The processor time and the memory
/// are those that the process has used until now.
RunSummary summarise(const Slam& slam, const Trajectory& trajectory, std::size_t map_points,
                     const RunCounts& counts, const HealthLog& health, const RunFacts& facts);

/// Adds the errors of a corrected trajectory and of the odometry against the truth. Throws
/// InputError, which begins with the file of the truth, when that is of another recording.
void add_errors(const NamedTruth& truth, const DatasetFacts& dataset, const Trajectory& odometry,
                const Trajectory& trajectory, RunSummary& summary);

}  // namespace lego_loam_sc
