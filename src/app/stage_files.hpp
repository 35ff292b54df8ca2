// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "app/scan_stages.hpp"

namespace lego_loam_sc {

/// Writes the stages as rows.ply, segments.ply, roughness.ply, features_large.ply and
/// features_small.ply: the same points with all that is known about each, in the colours of that
/// stage.
void write_stage_clouds(const std::filesystem::path& folder, const ScanStages& stages);

/// Writes stages.json, what the clouds do not say: the input, what was printed of it (`summary`),
/// the size of the range image and the elevation angle of each row.
void write_stage_facts(const std::filesystem::path& folder, const ScanStages& stages,
                       const SensorModel& sensor, const std::string& input,
                       const std::string& summary);

}  // namespace lego_loam_sc
