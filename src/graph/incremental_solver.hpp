// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtsam/nonlinear/ISAM2.h>
#include <gtsam/nonlinear/NonlinearFactorGraph.h>
#include <gtsam/nonlinear/Values.h>

namespace lego_loam_sc {

/// The condensed pose graph in iSAM2 (Kaess et al., "iSAM2: Incremental smoothing and mapping
/// using the Bayes tree", IJRR 2012), private to the pose graph. The tree is kept from loop to
/// loop: each step eliminates anew what changed factors and moved variables touch, and no more.
class IncrementalSolver {
 public:
  /// m and rad that a variable may move before its factors are linearised anew.
  explicit IncrementalSolver(double precision);

  /// One Gauss-Newton step towards the optimum of `graph`; returns all of its variables. Factors
  /// are told apart by their pointers: those that the tree lacks are added, those that `graph`
  /// lacks are removed. `estimate` holds every variable as the last step left it, new ones where
  /// they are to start. When the step fails or leads uphill, Levenberg-Marquardt solves the whole
  /// graph instead, and the next step builds the tree anew from there.
  gtsam::Values step(const gtsam::NonlinearFactorGraph& graph, const gtsam::Values& estimate);

 private:
  bool update(const gtsam::NonlinearFactorGraph& graph, const gtsam::Values& estimate);

  gtsam::ISAM2Params params_;
  gtsam::ISAM2 tree_;
};

}  // namespace lego_loam_sc
