// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/trajectory.hpp"
#include "sim/uniform_spline.hpp"

namespace lego_loam_sc {

/// Where a vehicle was on the plan at each time.
struct Track {
  UniformSpline<Eigen::Vector3d> plan;  ///< x, y (m) and yaw (rad, not wrapped) over time (s)
  UniformSpline<double> height;         ///< m, over time (s)
};

/// The smooth motion through the poses of a route from the first stamp on, free of the jumps of a
/// recording: what lasts less than two seconds is smoothed away. Throws InputError when the route
/// is too short, too wide, faster than any car or its stamps do not rise.
Track make_track(const Trajectory& route);

/// The way of a track by distance.
struct Way {
  UniformSpline<Eigen::Vector2d> path;  ///< x, y (m) over the length travelled (m)
  UniformSpline<double> travelled;      ///< m, over time (s)
};

/// Measures how far a track has led at each time.
Way way_of(const Track& track);

}  // namespace lego_loam_sc
