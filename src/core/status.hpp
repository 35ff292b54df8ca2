// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace lego_loam_sc {

/// What became of a scan. A bad scan is an outcome, not the end of a run: in the last three cases
/// the pose is the predicted one, and the scan changes nothing else.
enum class Status {
  ok,
  degenerate,      ///< matched, but at least one direction is held by the prediction alone
  odometry_only,   ///< the match against the map did not hold, that with the previous scan did
  too_few_points,  ///< not enough points or features to match
  lost,            ///< matched neither the map nor the previous scan
  out_of_order,    ///< its stamp is not after the one before; the scan was ignored
};

/// Whether the pose was found, not predicted: by the map or by the previous scan.
constexpr bool is_placed(Status status) {
  return status == Status::ok || status == Status::degenerate || status == Status::odometry_only;
}

constexpr std::string_view to_string(Status status) {
  switch (status) {
    case Status::ok: return "ok";
    case Status::degenerate: return "degenerate";
    case Status::odometry_only: return "odometry_only";
    case Status::too_few_points: return "too_few_points";
    case Status::lost: return "lost";
    case Status::out_of_order: return "out_of_order";
  }
  return "unknown";
}

}  // namespace lego_loam_sc
