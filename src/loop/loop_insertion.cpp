// SPDX-License-Identifier: BSD-3-Clause
#include "loop/loop_insertion.hpp"

namespace lego_loam_sc {
namespace {

// Consistent loops are batched: re-optimise when they are this share of all loops. Of true ones 19
// in 20 are as near to the graph as this.
constexpr double kConsistent = 3.5;
constexpr double kBatchShare = 1.0 / 32.0;

}  // namespace

bool LoopInsertion::insert(const PoseEdge& loop, bool joins_maps, PoseGraph& graph) {
  const bool consistent = !joins_maps && graph.chi(loop) < kConsistent;
  graph.add_loop(loop);
  const std::size_t loops = graph.loop_edges().size();
  if (consistent && ++loops_since_optimisation_ <= kBatchShare * static_cast<double>(loops))
    return true;
  loops_since_optimisation_ = 0;
  graph.optimise();
  if (graph.loop_chi(loops - 1) <= contradiction_sigmas_) return true;
  graph.remove_loop(loops - 1);
  graph.optimise();
  return false;
}

}  // namespace lego_loam_sc
