// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

/// Benchmarks of the pose graph: what a key frame and the worst of 500 loops cost in a drive of
/// 20,000 key frames.
void add_graph_benchmarks();

}  // namespace lego_loam_sc
