// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/trajectory.hpp"
#include "sim/uniform_spline.hpp"

namespace lego_loam_sc {

/// The trajectory of a vehicle in the horizontal plane, with its height.
struct Track {
  UniformSpline<Eigen::Vector3d> plan;  ///< x, y (m), yaw (rad, unwrapped) over time (s)
  UniformSpline<double> height;         ///< m, over time (s)
};

/// The smooth motion along the poses of a route from the first stamp on. Motion of periods below
/// two seconds, such as jumps of a recording, is smoothed away. Throws InputError when the route is
/// too short, too wide, faster than any car or its stamps do not ascend.
Track make_track(const Trajectory& route);

/// A track parametrised by distance.
struct TrackPath {
  UniformSpline<Eigen::Vector2d> curve;  ///< x, y (m) over the length travelled (m)
  UniformSpline<double> travelled;       ///< m, over time (s)
};

/// Parametrises a track by distance.
TrackPath path_of(const Track& track);

}  // namespace lego_loam_sc
