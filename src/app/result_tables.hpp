// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "app/health_log.hpp"
#include "slam/report.hpp"

namespace lego_loam_sc {

// Lines of the tables of a run, with line end; docs/output.md explains the columns.

/// Of scans.csv.
/// @{
extern const char* const kScansHeader;
std::string scan_line(const ScanReport& report, const HealthLog::Line& health);
/// @}

/// Of loops.csv.
/// @{
extern const char* const kLoopsHeader;
std::string loop_line(const LoopReport& report);
/// @}

}  // namespace lego_loam_sc
