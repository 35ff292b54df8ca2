// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace lego_loam_sc {

/// The outcome of a scan. A bad scan does not end the run: with `too_few_points` and `lost` the
/// pose is the prediction; these, a repeated scan and one out of order have no other effect.
enum class Status {
  ok,
  degenerate,      ///< matched, but at least one direction comes from the prediction alone
  odometry_only,   ///< matched the previous scan, but not the map
  too_few_points,  ///< not enough points or features to match
  lost,            ///< matched neither the map nor the previous scan
  repeated,        ///< the points of the scan before, byte for byte: the pose stays where it was
  out_of_order,    ///< its stamp is not later than the previous one; ignored
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
    case Status::repeated: return "repeated";
    case Status::out_of_order: return "out_of_order";
  }
  return "unknown";
}

}  // namespace lego_loam_sc
