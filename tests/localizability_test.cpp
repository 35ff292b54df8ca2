// SPDX-License-Identifier: BSD-3-Clause
#include "registration/localizability.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

// Points on the floor, ceiling and walls of a tunnel along the x axis.
std::vector<Correspondence> tunnel() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(-20.0, 20.0), across(-2.0, 2.0);
  std::vector<Correspondence> all;
  for (int i = 0; i < 400; ++i) {
    Correspondence c;
    const int axis = 1 + i % 2;
    c.direction = (i % 4 < 2 ? 1.0 : -1.0) * Vector3d::Unit(axis);
    c.point = Vector3d(along(random), across(random), across(random));
    c.point[axis] = -2.0 * c.direction[axis];
    c.anchor = c.point;
    all.push_back(c);
  }
  return all;
}

TEST(Localizability, ATunnelIsDegenerateAlongItsAxisAlone) {
  const Localizability result = localizability(tunnel(), Pose::Identity(), 3.0, 3.0);
  EXPECT_EQ(result.degenerate_translations, 1);
  EXPECT_EQ(result.degenerate_rotations, 0);
  EXPECT_NEAR(std::abs(result.translation_axes(0, 0)), 1.0, 1e-9);
}

TEST(Localizability, TheComponentAlongDegenerateDirectionsIsAProjection) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  Localizability l;
  l.translation_axes = rotation_from_rpy(0.3, -0.4, 1.0);
  l.rotation_axes = rotation_from_rpy(-1.0, 0.2, 0.5);
  l.translation_certainty.head<2>().setZero();
  l.rotation_certainty[0] = 0.0;
  const Matrix6 projection = degenerate_projection(l, 1.0, 1.0);
  EXPECT_LT((projection * projection - projection).norm(), 1e-14);
  EXPECT_NEAR(projection.trace(), 3.0, 1e-14);
  Vector6 delta;
  for (double& value : delta) value = normal(random);
  EXPECT_LT((degenerate_component(l, delta) - projection * delta).norm(), 1e-14);
  const Matrix6 weighted = degenerate_projection(l, 4.0, 9.0);
  EXPECT_LT((weighted.topLeftCorner<3, 3>() - 4.0 * projection.topLeftCorner<3, 3>()).norm(),
            1e-13);
  EXPECT_LT(
      (weighted.bottomRightCorner<3, 3>() - 9.0 * projection.bottomRightCorner<3, 3>()).norm(),
      1e-13);
}

TEST(Localizability, WithoutDegenerateDirectionsTheComponentIsZero) {
  EXPECT_EQ(degenerate_component(Localizability{}, Vector6::Ones()), Vector6::Zero());
}

}  // namespace
}  // namespace lego_loam_sc
