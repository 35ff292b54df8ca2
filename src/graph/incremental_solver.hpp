// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtsam/nonlinear/ISAM2.h>
#include <gtsam/nonlinear/NonlinearFactorGraph.h>
#include <gtsam/nonlinear/Values.h>

namespace lego_loam_sc {

/// The condensed pose graph in iSAM2 (Kaess et al., "iSAM2: Incremental smoothing and mapping
/// using the Bayes tree", IJRR 2012), private to the pose graph. The tree is kept between loops:
/// each step eliminates only what changed factors and moved variables affect.
class IncrementalSolver {
 public:
  /// `precision` (m and rad): a variable that moved by more is relinearised.
  explicit IncrementalSolver(double precision);

  /// One Gauss-Newton step towards the optimum of `graph`; returns all of its variables. Factors
  /// are identified by their pointers: factors missing from the tree are added, factors missing
  /// from `graph` removed. `estimate` holds all variables after the last step and the initial
  /// values of new ones. When the step fails or increases the cost, Levenberg-Marquardt solves the
  /// whole graph instead, and the next step rebuilds the tree.
  gtsam::Values step(const gtsam::NonlinearFactorGraph& graph, const gtsam::Values& estimate);

 private:
  bool update(const gtsam::NonlinearFactorGraph& graph, const gtsam::Values& estimate);

  gtsam::ISAM2Params params_;
  gtsam::ISAM2 tree_;
};

}  // namespace lego_loam_sc
