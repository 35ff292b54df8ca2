// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "loop/loop_verifier.hpp"
#include "loop/scan_context.hpp"
#include "slam/settings.hpp"

namespace lego_loam_sc {

/// Two scans compared as a loop candidate.
struct ScanMatch {
  ScanContextMatch scan_context;
  LoopVerification verification;  ///< T_match_query maps points of b into a
};

/// Treats `b` as the query and `a` as the match, as the loop closer does with two key frames that
/// have no neighbours: Scan Context must find them alike (equation (8)) and gives the yaw that ICP
/// starts from. Points are not de-skewed.
ScanMatch match_scans(const Scan& a, const Scan& b, const SensorModel& sensor,
                      const Settings& settings);

}  // namespace lego_loam_sc
