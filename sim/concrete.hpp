// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/pose.hpp"
#include "sim/mesh.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {

// Walls and passages of an underground building. All lengths in m.

/// Maximum distance of a wall panel behind the line of the wall.
constexpr double kSetback = 0.3;

/// A wall in panels that stand back by different amounts, with doors, pilasters and cabinets. The
/// room lies to the left of the way from `start` to `end`, its floor at z = 0.
void add_wall(Mesh& mesh, const Eigen::Vector2d& start, const Eigen::Vector2d& end, double height,
              Random& random);

/// The foot of a ramp that leads up and out of the building and ends at a steel door, 6 m wide and
/// 16 m long. `T_world_foot` places the middle of its foot, x upwards along the ramp.
void add_entrance(Mesh& mesh, const Pose& T_world_foot);

/// A ramp along x in a shaft of its own, with level landings at both ends that are open towards
/// positive y.
struct Ramp {
  static constexpr double kLanding = 6.0, kWidth = 5.3;

  double x_begin, x_end;  ///< of the shaft
  double y;               ///< of its middle
  double z_begin, z_end;  ///< of the landings

  /// Height of the floor at x; level beyond the ends. Its slope is continuous.
  double height(double x) const;
};

/// The shaft of a ramp, `clear_height` high, held by concrete frames.
void add_ramp(Mesh& mesh, const Ramp& ramp, double clear_height);

/// A straight level passage along y without ends, as wide as a ramp's landing. The floor's middle
/// line goes from (x, y_begin) to (x, y_end) at height z.
void add_passage(Mesh& mesh, double x, double y_begin, double y_end, double z, double clear_height);

}  // namespace lego_loam_sc
