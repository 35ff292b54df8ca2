// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace lego_loam_sc {

/// A pair of key frames that may show the same place; the verifier decides.
struct LoopCandidate {
  /// What found it.
  enum class Detector { scan_context, radius, custom };

  int query = 0;  ///< key frame, the later one
  int match = 0;  ///< key frame of the earlier visit, c* of equation (8)
  Detector detector = Detector::scan_context;
  double distance = 0.0;  ///< Scan Context: D of equation (5), in [0, 1]; radius search: m
  double yaw = 0.0;       ///< rad, T_match_query turns by about R_z(yaw); 0 by the radius search
};

/// As it stands in loops.csv.
constexpr std::string_view to_string(LoopCandidate::Detector detector) {
  switch (detector) {
    case LoopCandidate::Detector::scan_context: return "scan_context";
    case LoopCandidate::Detector::radius: return "radius";
    case LoopCandidate::Detector::custom: return "custom";
  }
  return "unknown";
}

}  // namespace lego_loam_sc
