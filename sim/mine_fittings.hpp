// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/mesh.hpp"
#include "sim/random.hpp"
#include "sim/roadway.hpp"

namespace lego_loam_sc {

// Equipment in a mine's roadway, between two distances (m) along its line. The middle stays free,
// 1.5 m to either side and 2 m high.

/// Two pipes along the right wall.
void add_pipes(Mesh& mesh, const Roadway& roadway, double from, double to);

/// A belt conveyor along the right wall.
void add_conveyor(Mesh& mesh, const Roadway& roadway, double from, double to);

/// Steel arches, one every 1.5 m, set by hand.
void add_steel_arches(Mesh& mesh, const Roadway& roadway, double from, double to, Random& random);

/// Timber props along both walls, every few metres.
void add_props(Mesh& mesh, const Roadway& roadway, double from, double to, Random& random);

/// Cabinets, boxes and heaps of spoil along the left wall and boards under the roof, here and
/// there.
void add_clutter(Mesh& mesh, const Roadway& roadway, double from, double to, Random& random);

/// A parked loader, 6 m long.
void add_loader(Mesh& mesh, const Pose& T_world_loader);

}  // namespace lego_loam_sc
