// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pose.hpp"

namespace lego_loam_sc {

/// The pose of a scan at its stamp, seen from its pose at its reference time, when the stamp lies
/// `age` seconds after that time: at constant velocity. `twist` in m/s and rad/s, own axes.
Pose extrapolate(const Vector6& twist, double age);

/// The same when the stamp lies between the reference times of the scan before, `seconds` ago, and
/// of this one: on the cubic through both poses with both velocities (Hermite). Elsewhere
/// extrapolated.
Pose interpolate(const Pose& T_previous_current, const Vector6& twist_previous,
                 const Vector6& twist, double seconds, double age);

}  // namespace lego_loam_sc
