// SPDX-License-Identifier: BSD-3-Clause
#include "graph/incremental_solver.hpp"

#include <gtsam/linear/linearExceptions.h>
#include <gtsam/nonlinear/LevenbergMarquardtOptimizer.h>

#include <cstddef>
#include <unordered_set>

namespace lego_loam_sc {
namespace {

// Tolerance for a cost increase by round-off and by moves too small to relinearise.
constexpr double kCostTolerance = 1e-6;

gtsam::ISAM2Params incremental_params(double precision) {
  gtsam::ISAM2Params params;
  // Propagate far smaller changes down to the leaves: a segment multiplies rotations by its length.
  params.optimizationParams = gtsam::ISAM2GaussNewtonParams(0.01 * precision);
  params.relinearizeThreshold = precision;
  params.relinearizeSkip = 1;
  params.evaluateNonlinearError = true;
  params.findUnusedFactorSlots = true;  // reuses the slots of removed factors
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

// Returns false when the step fails or increases the cost.
bool IncrementalSolver::update(const gtsam::NonlinearFactorGraph& graph,
                               const gtsam::Values& estimate) {
  const gtsam::NonlinearFactorGraph& present = tree_.getFactorsUnsafe();
  const FactorSet existing = set_of(present);
  const FactorSet wanted = set_of(graph);
  gtsam::NonlinearFactorGraph added;
  for (const auto& factor : graph)
    if (!existing.contains(factor.get())) added.push_back(factor);
  gtsam::FactorIndices removed;
  for (std::size_t i = 0; i < present.size(); ++i)
    if (present[i] && !wanted.contains(present[i].get())) removed.push_back(i);
  gtsam::Values initial;
  for (const gtsam::Key key : added.keys())
    if (!tree_.valueExists(key)) initial.insert(key, estimate.at(key));
  try {
    const gtsam::ISAM2Result result = tree_.update(added, initial, removed);
    return *result.errorAfter <= *result.errorBefore * (1.0 + kCostTolerance) + kCostTolerance;
  } catch (const gtsam::IndeterminantLinearSystemException&) {
    // Cholesky squares the sigmas of stiff and loose directions, which can differ too much. QR
    // takes twice the time, so it is used only from here on.
    params_.factorization = gtsam::ISAM2Params::QR;
    return false;
  }
}

}  // namespace lego_loam_sc
