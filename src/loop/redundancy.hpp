// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "graph/pose_graph.hpp"

namespace lego_loam_sc {

/// m; two loops that end within this distance along the path belong to the same visit.
constexpr double kSameVisit = 20.0;
/// Near so many loops a consistent revisit is redundant.
constexpr double kWellTied = 5.0;

/// Loops that end near a key frame.
double count_loops_near(int key_frame, const PoseGraph& graph);

/// Whether a loop tells the graph nothing new. A visit must be tied to the one before, but driving
/// the same roads all day would let the graph grow without end. `since_last_loop`: m along the
/// path.
bool is_redundant(const PoseEdge& loop, double since_last_loop, const PoseGraph& graph);

}  // namespace lego_loam_sc
