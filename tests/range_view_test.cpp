// SPDX-License-Identifier: BSD-3-Clause
#include "map/range_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lego_loam_sc {
namespace {

// A wall at x = 10, seen from the origin, as high and wide as 30 degrees to each side.
std::vector<Eigen::Vector3f> wall() {
  std::vector<Eigen::Vector3f> points;
  for (float azimuth = -0.5f; azimuth <= 0.5f; azimuth += 0.005f)
    for (float elevation = -0.5f; elevation <= 0.5f; elevation += 0.01f)
      points.emplace_back(10.0f, 10.0f * std::tan(azimuth),
                          10.0f * std::tan(elevation) / std::cos(azimuth));
  return points;
}

TEST(RangeView, KnowsWhatIsFreeWhatIsASurfaceAndWhatIsHidden) {
  const RangeView view(wall(), 0.01);
  EXPECT_EQ(view.sight({10.0f, 1.0f, 0.5f}), RangeView::Sight::surface);
  EXPECT_EQ(view.sight({10.2f, 1.0f, 0.5f}), RangeView::Sight::surface);
  EXPECT_EQ(view.sight({6.0f, 1.0f, 0.5f}), RangeView::Sight::free);
  EXPECT_EQ(view.sight({14.0f, 1.0f, 0.5f}), RangeView::Sight::unknown);
  EXPECT_EQ(view.sight({-6.0f, 1.0f, 0.5f}), RangeView::Sight::unknown);
}

// Rows of two degrees leave gaps: between two rows of the ground nothing is free.
TEST(RangeView, TheGroundBetweenTwoRowsIsNoFreeSpace) {
  std::vector<Eigen::Vector3f> ground;
  for (int row = 0; row < 8; ++row)
    for (float azimuth = -3.1f; azimuth < 3.1f; azimuth += 0.005f) {
      const float range = 1.8f / std::tan(0.035f * static_cast<float>(row + 1));
      ground.emplace_back(range * std::cos(azimuth), range * std::sin(azimuth), -1.8f);
    }
  const RangeView view(ground, 0.035);
  for (float x = 7.0f; x < 40.0f; x += 0.1f)
    EXPECT_NE(view.sight({x, 0.3f, -1.8f}), RangeView::Sight::free) << x;
}

TEST(RangeView, WithoutPointsKnowsNothing) {
  EXPECT_EQ(RangeView({}, 0.01).sight({1, 0, 0}), RangeView::Sight::unknown);
}

}  // namespace
}  // namespace lego_loam_sc
