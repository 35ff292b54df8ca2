// SPDX-License-Identifier: BSD-3-Clause
#include "graph/incremental_solver.hpp"

#include <gtsam/linear/linearExceptions.h>
#include <gtsam/nonlinear/LevenbergMarquardtOptimizer.h>

#include <cstddef>
#include <unordered_set>

namespace lego_loam_sc {
namespace {

// The cost of an optimum flickers by rounding, and by moves too small to linearise anew.
constexpr double kFlicker = 1e-6;

gtsam::ISAM2Params incremental_params(double precision) {
  gtsam::ISAM2Params params;
  // Far smaller changes are carried down to the leaves: a stretch multiplies rotation by its
  // length.
  params.optimizationParams = gtsam::ISAM2GaussNewtonParams(0.01 * precision);
  params.relinearizeThreshold = precision;
  params.relinearizeSkip = 1;
  params.evaluateNonlinearError = true;
  params.findUnusedFactorSlots = true;  // else each factor ever removed would leave an empty one
  return params;
}

using FactorSet = std::unordered_set<const gtsam::NonlinearFactor*>;

FactorSet set_of(const gtsam::NonlinearFactorGraph& graph) {
  FactorSet factors;
  for (const auto& factor : graph) factors.insert(factor.get());
  return factors;
}

}  // namespace

IncrementalSolver::IncrementalSolver(double precision)
    : params_(incremental_params(precision)), tree_(params_) {}

gtsam::Values IncrementalSolver::step(const gtsam::NonlinearFactorGraph& graph,
                                      const gtsam::Values& estimate) {
  if (update(graph, estimate)) return tree_.calculateEstimate();
  tree_ = gtsam::ISAM2(params_);
  return gtsam::LevenbergMarquardtOptimizer(graph, estimate).optimize();
}

// False when the tree has no step that can be trusted.
bool IncrementalSolver::update(const gtsam::NonlinearFactorGraph& graph,
                               const gtsam::Values& estimate) {
  const gtsam::NonlinearFactorGraph& present = tree_.getFactorsUnsafe();
  const FactorSet had = set_of(present);
  const FactorSet wanted = set_of(graph);
  gtsam::NonlinearFactorGraph added;
  for (const auto& factor : graph)
    if (!had.contains(factor.get())) added.push_back(factor);
  gtsam::FactorIndices removed;
  for (std::size_t i = 0; i < present.size(); ++i)
    if (present[i] && !wanted.contains(present[i].get())) removed.push_back(i);
  gtsam::Values started;
  for (const gtsam::Key key : added.keys())
    if (!tree_.valueExists(key)) started.insert(key, estimate.at(key));
  try {
    const gtsam::ISAM2Result result = tree_.update(added, started, removed);
    return *result.errorAfter <= *result.errorBefore * (1.0 + kFlicker) + kFlicker;
  } catch (const gtsam::IndeterminantLinearSystemException&) {
    // Sigmas of tight and loose directions too far apart for Cholesky, which squares them. QR
    // takes twice the time, so not before this.
    params_.factorization = gtsam::ISAM2Params::QR;
    return false;
  }
}

}  // namespace lego_loam_sc
