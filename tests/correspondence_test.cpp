// SPDX-License-Identifier: BSD-3-Clause
#include "registration/correspondence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lego_loam_sc {
namespace {

using Kind = Correspondence::Kind;
using Eigen::Vector3d;

class Draw {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vector3d vector(double reach) {
    return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
  }
  Vector3d unit() {
    Vector3d v = vector(1.0);
    while (v.norm() < 0.1) v = vector(1.0);
    return v.normalized();
  }
  Pose pose() {
    Pose pose = Pose::Identity();
    pose.linear() = exp_so3(uniform(-3.0, 3.0) * unit());
    pose.translation() = vector(20.0);
    return pose;
  }
  // Off its plane or line by about `off`.
  Correspondence correspondence(Kind kind, const Pose& T_target_source, double off) {
    Correspondence c;
    c.kind = kind;
    c.point = vector(30.0);
    c.anchor = T_target_source * c.point + vector(off);
    c.direction = kind == Kind::point ? Vector3d(0, 0, 0) : unit();
    c.time = uniform(-0.05, 0.05);
    c.weight = uniform(0.5, 50.0);
    return c;
  }
  std::vector<Correspondence> some(const Pose& T_target_source, double off) {
    std::vector<Correspondence> all;
    for (int i = 0; i < 12; ++i)
      all.push_back(correspondence(static_cast<Kind>(i % 3), T_target_source, off));
    return all;
  }

 private:
  std::mt19937 random_{7};
};

// By central differences of the cost.
Vector6 numeric_gradient(const std::vector<Correspondence>& all, const Pose& pose, double scale) {
  constexpr double kStep = 1e-6;
  Vector6 gradient;
  for (int i = 0; i < 6; ++i) {
    const Vector6 step = kStep * Vector6::Unit(i);
    gradient[i] = (normal_equations(all, perturb(pose, step), scale).cost -
                   normal_equations(all, perturb(pose, -step), scale).cost) /
                  (2.0 * kStep);
  }
  return gradient;
}

TEST(Correspondence, TheDistanceToAPlaneIsAlongItsNormalAndToALineAcrossIt) {
  Correspondence c;
  c.point = Vector3d(1.0, 2.0, 3.0);
  c.anchor = Vector3d(0.0, 0.0, 1.0);
  c.direction = Vector3d::UnitZ();
  EXPECT_DOUBLE_EQ(distance(c, Pose::Identity()), 2.0);
  c.kind = Kind::line;
  EXPECT_DOUBLE_EQ(distance(c, Pose::Identity()), std::sqrt(5.0));
}

TEST(Correspondence, TheGradientOfTheRobustCostIsG) {
  Draw draw;
  for (int trial = 0; trial < 50; ++trial) {
    const Pose pose = draw.pose();
    const auto all = draw.some(pose, 0.5);
    for (const double scale : {0.05, 0.5, 100.0}) {
      const Vector6 g = normal_equations(all, pose, scale).g;
      EXPECT_LT((g - numeric_gradient(all, pose, scale)).norm(), 1e-5 * (1.0 + g.norm()));
    }
  }
}

TEST(Correspondence, TheHessianOfPointsOnTheirSurfacesIsTheSecondDerivativeOfTheCost) {
  // With residuals of zero the Gauss-Newton approximation is exact.
  Draw draw;
  constexpr double kStep = 1e-4;
  for (int trial = 0; trial < 20; ++trial) {
    const Pose pose = draw.pose();
    const auto all = draw.some(pose, 0.0);
    const Matrix6 H = normal_equations(all, pose, 5.0).H;
    for (int i = 0; i < 6; ++i) {
      const Vector6 step = kStep * Vector6::Unit(i);
      const Vector6 column = (normal_equations(all, perturb(pose, step), 5.0).g -
                              normal_equations(all, perturb(pose, -step), 5.0).g) /
                             (2.0 * kStep);
      EXPECT_LT((H.col(i) - column).norm(), 1e-3 * H.norm());
    }
  }
}

TEST(Correspondence, TheHessianIsTheWeightedSumOfSquaredNumericJacobians) {
  Draw draw;
  constexpr double kStep = 1e-6;
  constexpr double kScale = 0.3;
  for (int trial = 0; trial < 50; ++trial) {
    const Pose pose = draw.pose();
    for (const Kind kind : {Kind::plane, Kind::line, Kind::point}) {
      const Correspondence c = draw.correspondence(kind, pose, 0.4);
      // The residual of a line as a vector: the part of the offset across the line; of a point all
      // of it.
      const auto residual = [&](const Pose& at) -> Vector3d {
        const Vector3d offset = at * c.point - c.anchor;
        const Vector3d along = c.direction.dot(offset) * c.direction;
        return kind == Kind::plane ? along : Vector3d(offset - along);
      };
      Eigen::Matrix<double, 3, 6> J;
      for (int i = 0; i < 6; ++i) {
        const Vector6 step = kStep * Vector6::Unit(i);
        J.col(i) = (residual(perturb(pose, step)) - residual(perturb(pose, -step))) / (2.0 * kStep);
      }
      const double ratio = residual(pose).norm() * std::sqrt(c.weight) / kScale;
      const Matrix6 expected = c.weight / (1.0 + ratio * ratio) * J.transpose() * J;
      const Matrix6 H = normal_equations(std::vector{c}, pose, kScale).H;
      EXPECT_LT((H - expected).norm(), 1e-6 * (1.0 + expected.norm()));
    }
  }
}

TEST(Correspondence, TheGradientOfASweepIsThatOfItsCostByPoseAndVelocity) {
  Draw draw;
  constexpr double kStep = 1e-6;
  constexpr double kScale = 0.5;
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  for (int trial = 0; trial < 50; ++trial) {
    const Pose pose = draw.pose();
    const auto all = draw.some(pose, 0.3);
    const auto at = [&](const Vector12& delta) {
      return sweep_normal_equations(all, perturb(pose, delta.head<6>()), delta.tail<6>(), kScale);
    };
    Vector12 numeric;
    for (int i = 0; i < 12; ++i) {
      const Vector12 step = kStep * Vector12::Unit(i);
      numeric[i] = (at(step).cost - at(-step).cost) / (2.0 * kStep);
    }
    const Vector12 g = at(Vector12::Zero()).g;
    EXPECT_LT((g - numeric).norm(), 1e-5 * (1.0 + g.norm()));
  }
}

TEST(Correspondence, TheSweepOfPointsOnTheirSurfacesHasTheSecondDerivativeOfItsCost) {
  Draw draw;
  constexpr double kStep = 1e-4;
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  const Pose pose = draw.pose();
  const auto all = draw.some(pose, 0.0);
  const auto at = [&](const Vector12& delta) {
    return sweep_normal_equations(all, perturb(pose, delta.head<6>()), delta.tail<6>(), 5.0);
  };
  const auto H = at(Vector12::Zero()).H;
  EXPECT_LT((H.topLeftCorner<6, 6>() - normal_equations(all, pose, 5.0).H).norm(), 1e-9 * H.norm());
  for (int i = 0; i < 12; ++i) {
    const Vector12 step = kStep * Vector12::Unit(i);
    const Vector12 column = (at(step).g - at(-step).g) / (2.0 * kStep);
    EXPECT_LT((H.col(i) - column).norm(), 1e-3 * H.norm());
  }
}

TEST(Correspondence, AFarPointHasNoInfluence) {
  Draw draw;
  const Pose pose = draw.pose();
  auto all = draw.some(pose, 0.01);
  const Vector6 without = normal_equations(all, pose, 0.05).g;
  Correspondence far = draw.correspondence(Kind::plane, pose, 0.0);
  far.anchor -= 1e4 * far.direction;
  all.push_back(far);
  EXPECT_LT((normal_equations(all, pose, 0.05).g - without).norm(), 1e-3 * without.norm());
}

TEST(Correspondence, ARestrictedProblemHoldsTheAskedForRowsAndColumns) {
  Draw draw;
  const Pose pose = draw.pose();
  const auto all = normal_equations(draw.some(pose, 0.3), pose, 0.5);
  const std::array<int, 3> unknowns{5, 0, 2};
  const NormalEquations<3> some = restrict_to(all, unknowns);
  EXPECT_EQ(some.cost, all.cost);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(some.g[i], all.g[unknowns[i]]);
    for (int j = 0; j < 3; ++j) EXPECT_EQ(some.H(i, j), all.H(unknowns[i], unknowns[j]));
  }
}

TEST(Correspondence, TheRobustScaleIsTheSigmaOfGaussianResiduals) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  std::vector<Correspondence> all(20000);
  for (Correspondence& c : all) {
    c.point = noise(random) * Vector3d::UnitZ();
    c.anchor = Vector3d::Zero();
    c.direction = Vector3d::UnitZ();
  }
  EXPECT_NEAR(robust_scale(all, Pose::Identity(), {3.0, 1e-6, 1e6}), 0.06, 0.0015);
  // A third of outliers moves it little.
  for (std::size_t i = 0; i < all.size(); i += 3) all[i].point *= 1000.0;
  EXPECT_LT(robust_scale(all, Pose::Identity(), {3.0, 1e-6, 1e6}), 0.12);
}

TEST(Correspondence, TheRobustScaleStaysWithinItsLimits) {
  std::vector<Correspondence> all(3);
  for (Correspondence& c : all) {
    c.point = c.anchor = Vector3d::Zero();
    c.direction = Vector3d::UnitX();
  }
  EXPECT_EQ(robust_scale(all, Pose::Identity(), {2.0, 0.05, 1.0}), 0.05);
  EXPECT_EQ(robust_scale(all, Pose(Eigen::Translation3d(100.0, 0.0, 0.0)), {2.0, 0.05, 1.0}), 1.0);
  EXPECT_EQ(robust_scale({}, Pose::Identity(), {2.0, 0.05, 1.0}), 1.0);
}

}  // namespace
}  // namespace lego_loam_sc
