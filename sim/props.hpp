// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pose.hpp"
#include "sim/mesh.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {

// Objects beside a road. `T_world_...` places the centre of the base on the ground, x along the
// length. Sizes and materials vary randomly within usual limits.

/// A parked car: hatchback, saloon or van, 3.8 to 5 m long.
void add_car(Mesh& mesh, const Pose& T_world_car, Random& random);

/// A trunk with a crown of leaves, 5 to 9 m high.
void add_tree(Mesh& mesh, const Pose& T_world_tree, Random& random);

/// A hedge of leaves, `length` (m) long.
void add_hedge(Mesh& mesh, const Pose& T_world_hedge, double length, Random& random);

/// A lamp post with its arm along x.
void add_lamp(Mesh& mesh, const Pose& T_world_lamp);

/// A traffic sign that faces x.
void add_sign(Mesh& mesh, const Pose& T_world_sign);

}  // namespace lego_loam_sc
