// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace lego_loam_sc {

/// Cost and its Gauss-Newton model at one state: cost(delta) ~ cost + g'delta + delta'H delta / 2.
template <int N>
struct NormalEquations {
  Eigen::Matrix<double, N, N> H = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> g = Eigen::Matrix<double, N, 1>::Zero();
  double cost = 0.0;
};

/// A step below this ends an optimisation: 0.1 mm and 0.1 mrad.
constexpr double kStepConvergence = 1e-4;

/// How a minimisation went.
struct LevenbergMarquardtResult {
  int iterations = 0;
  double step = 0.0;  ///< largest component of the sum of the accepted steps
};

/// Minimises by Levenberg-Marquardt with full steps and Marquardt's damping of the diagonal.
/// `evaluate(state)` returns NormalEquations<N>, `apply(state, delta)` the state moved by `delta`.
template <int N, class State, class Evaluate, class Apply>
LevenbergMarquardtResult levenberg_marquardt(State& state, int max_iterations, Evaluate&& evaluate,
                                             Apply&& apply) {
  using Vector = Eigen::Matrix<double, N, 1>;
  LevenbergMarquardtResult result;
  Vector total = Vector::Zero();
  NormalEquations<N> here = evaluate(state);
  double damping = 1e-4;
  while (result.iterations < max_iterations) {
    ++result.iterations;
    Eigen::Matrix<double, N, N> damped = here.H;
    damped.diagonal() += damping * here.H.diagonal();
    damped.diagonal().array() +=
        1e-9;  // keeps the system regular: unconstrained directions do not move
    const Vector delta = damped.ldlt().solve(-here.g);
    if (!delta.allFinite()) break;

    const State candidate = apply(state, delta);
    const NormalEquations<N> there = evaluate(candidate);
    const double predicted = -(here.g.dot(delta) + 0.5 * delta.dot(here.H * delta));
    const double gain = predicted > 0.0 ? (here.cost - there.cost) / predicted : -1.0;
    if (gain > 0.0) {
      state = candidate;
      here = there;
      total += delta;
      damping = std::max(damping * (gain > 0.75 ? 0.1 : 1.0), 1e-9);
    } else {
      damping *= 10.0;
    }
    if (delta.cwiseAbs().maxCoeff() < kStepConvergence || damping > 1e9) break;
  }
  result.step = total.cwiseAbs().maxCoeff();
  return result;
}

}  // namespace lego_loam_sc
