// SPDX-License-Identifier: BSD-3-Clause
#include "graph/edge_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

namespace lego_loam_sc {
namespace {

Matrix6 some_covariance(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gaussian;
  Matrix6 A;
  for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = 0.01 * gaussian(random);
  return A * A.transpose();
}

// Of the right perturbation: T * exp_se3(noise) = perturb(T, delta), by central differences.
Matrix6 of_the_right_perturbation(const Matrix6& covariance, const Pose& T) {
  constexpr double kStep = 1e-6;
  Matrix6 J;
  for (int i = 0; i < 6; ++i) {
    const Vector6 step = kStep * Vector6::Unit(i);
    J.col(i) =
        (log_se3(T.inverse() * perturb(T, step)) - log_se3(T.inverse() * perturb(T, -step))) /
        (2.0 * kStep);
  }
  return J * covariance * J.transpose();
}

Matrix6 floor_of(double sigma, double sigma_deg) {
  Matrix6 result = Matrix6::Zero();
  result.diagonal().head<3>().setConstant(sigma * sigma);
  result.diagonal().tail<3>().setConstant(radians(sigma_deg) * radians(sigma_deg));
  return result;
}

TEST(EdgeCovariance, IsTheMatchersInTheAxesOfTheEdgesEndAndAFloor) {
  GraphSettings settings;
  settings.loop_sigma = 0.07;
  settings.loop_sigma_deg = 0.3;
  settings.odometry_sigma = 0.02;
  settings.odometry_sigma_deg = 0.1;
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> one(-1.0, 1.0);
    Vector6 twist;
    for (int i = 0; i < 6; ++i) twist[i] = 2.0 * one(random);
    const Pose T = exp_se3(twist);
    const Matrix6 matcher = some_covariance(seed);
    const Matrix6 turned = of_the_right_perturbation(matcher, T);
    EXPECT_LT(
        (loop_covariance(matcher, T.linear(), settings) - turned - floor_of(0.07, 0.3)).norm(),
        1e-9);
    EXPECT_LT(
        (odometry_covariance(matcher, T.linear(), {}, settings) - turned - floor_of(0.02, 0.1))
            .norm(),
        1e-9);
  }
}

TEST(EdgeCovariance, OnlyTheDegenerateDirectionIsInflated) {
  const GraphSettings settings;
  const Eigen::Matrix3d R = rotation_from_rpy(0.1, -0.2, 2.0);
  Localizability l;
  l.translation_axes = rotation_from_rpy(0.0, 0.0, 0.7);
  l.translation_certainty[0] = 0.0;
  l.rotation_axes = rotation_from_rpy(0.3, 0.0, 0.0);
  l.rotation_certainty[0] = 0.0;
  const Matrix6 change = odometry_covariance(some_covariance(1), R, l, settings) -
                         odometry_covariance(some_covariance(1), R, {}, settings);
  const double t = settings.degenerate_inflation * settings.odometry_sigma;
  const double r = settings.degenerate_inflation * radians(settings.odometry_sigma_deg);
  for (int i = 0; i < 3; ++i) {
    Vector6 along = Vector6::Zero(), about = Vector6::Zero();
    along.head<3>() = R.transpose() * l.translation_axes.col(i);
    about.tail<3>() = R.transpose() * l.rotation_axes.col(i);
    EXPECT_NEAR(along.dot(change * along), i == 0 ? t * t : 0.0, 1e-12);
    EXPECT_NEAR(about.dot(change * about), i == 0 ? r * r : 0.0, 1e-12);
  }
}

TEST(EdgeCovariance, IsPositiveDefiniteEvenWhenTheMatcherHasNone) {
  const Matrix6 covariance =
      odometry_covariance(Matrix6::Zero(), Eigen::Matrix3d::Identity(), {}, GraphSettings{});
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6>(covariance).eigenvalues()[0], 0.0);
}

}  // namespace
}  // namespace lego_loam_sc
