// SPDX-License-Identifier: BSD-3-Clause
#include "registration/levenberg_marquardt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lego_loam_sc {
namespace {

using Vector2 = Eigen::Vector2d;

constexpr auto kAdd = [](const Vector2& state, const Vector2& delta) -> Vector2 {
  return state + delta;
};

// Rosenbrock's valley as least squares: residuals 10 (y - x^2) and 1 - x, minimum at (1, 1).
NormalEquations<2> rosenbrock(const Vector2& state) {
  const Vector2 residual(10.0 * (state.y() - state.x() * state.x()), 1.0 - state.x());
  Eigen::Matrix2d J;
  J << -20.0 * state.x(), 10.0, -1.0, 0.0;
  return {J.transpose() * J, J.transpose() * residual, 0.5 * residual.squaredNorm()};
}

TEST(LevenbergMarquardt, FindsTheEndOfRosenbrocksValley) {
  Vector2 state(-1.2, 1.0);
  const auto result = levenberg_marquardt<2>(state, 200, rosenbrock, kAdd);
  EXPECT_LT((state - Vector2(1.0, 1.0)).norm(), 1e-3);
  EXPECT_LT(result.iterations, 200);
  EXPECT_NEAR(result.step, 2.2, 1e-2);  // the larger part of the way, 1 - (-1.2)
}

TEST(LevenbergMarquardt, SolvesALinearProblemToItsDampingInOneStep) {
  Eigen::Matrix2d A;
  A << 3.0, 1.0, 1.0, 2.0;
  const Vector2 minimum(4.0, -7.0);
  Vector2 state = Vector2::Zero();
  levenberg_marquardt<2>(
      state, 1,
      [&](const Vector2& at) {
        const Vector2 off = at - minimum;
        return NormalEquations<2>{A, A * off, 0.5 * off.dot(A * off)};
      },
      kAdd);
  EXPECT_LT((state - minimum).norm(), 1e-2);
}

TEST(LevenbergMarquardt, NeverAcceptsAWorseCost) {
  // After any number of iterations the state is no worse than after fewer.
  double before = rosenbrock({-1.2, 1.0}).cost;
  for (int iterations = 1; iterations <= 40; ++iterations) {
    Vector2 state(-1.2, 1.0);
    levenberg_marquardt<2>(state, iterations, rosenbrock, kAdd);
    const double cost = rosenbrock(state).cost;
    EXPECT_LE(cost, before);
    before = cost;
  }
}

TEST(LevenbergMarquardt, AGradientThatPointsUphillMovesNothing) {
  Vector2 state(0.5, 0.5);
  const Vector2 start = state;
  const auto result = levenberg_marquardt<2>(
      state, 50,
      [](const Vector2& at) {
        return NormalEquations<2>{Eigen::Matrix2d::Identity(), -at, 0.5 * at.squaredNorm()};
      },
      kAdd);
  EXPECT_EQ(state, start);
  EXPECT_EQ(result.step, 0.0);
}

TEST(LevenbergMarquardt, ADirectionWithoutConstraintStaysWhereItIs) {
  Vector2 state(5.0, 3.0);
  levenberg_marquardt<2>(
      state, 20,
      [](const Vector2& at) {
        NormalEquations<2> equations;
        equations.H(0, 0) = 100.0;
        equations.g[0] = 100.0 * (at.x() - 2.0);
        equations.cost = 50.0 * (at.x() - 2.0) * (at.x() - 2.0);
        return equations;
      },
      kAdd);
  EXPECT_NEAR(state.x(), 2.0, 1e-4);
  EXPECT_EQ(state.y(), 3.0);
}

TEST(LevenbergMarquardt, ASingularSumOfDirectionsIsSolvedAlongTheOther) {
  // Only x + y is constrained.
  Vector2 state(1.0, 2.0);
  levenberg_marquardt<2>(
      state, 20,
      [](const Vector2& at) {
        const double residual = at.sum() - 10.0;
        return NormalEquations<2>{Eigen::Matrix2d::Ones(), Vector2::Constant(residual),
                                  0.5 * residual * residual};
      },
      kAdd);
  EXPECT_NEAR(state.sum(), 10.0, 1e-3);
  EXPECT_NEAR(state.y() - state.x(), 1.0, 1e-6);
}

TEST(LevenbergMarquardt, NothingAtAllOrNotANumberMovesNothing) {
  for (const double value : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    Vector2 state(1.0, 2.0);
    levenberg_marquardt<2>(
        state, 20,
        [&](const Vector2&) {
          return NormalEquations<2>{Eigen::Matrix2d::Constant(value), Vector2::Constant(value),
                                    value};
        },
        kAdd);
    EXPECT_EQ(state, Vector2(1.0, 2.0));
  }
}

}  // namespace
}  // namespace lego_loam_sc
