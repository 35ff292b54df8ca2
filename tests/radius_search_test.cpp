// SPDX-License-Identifier: BSD-3-Clause
#include "loop/radius_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace lego_loam_sc {
namespace {

TEST(RadiusSearch, FindsWhatASearchThroughAllKeyFramesFinds) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> metres(-6, 6);  // whole numbers: many equal distances
  std::vector<Eigen::Vector3d> positions;
  for (int i = 0; i < 400; ++i)
    positions.emplace_back(1e5 + metres(random), metres(random), metres(random));
  std::vector<int> all(positions.size());
  std::iota(all.begin(), all.end(), 0);
  RadiusSearchSettings settings;
  settings.radius = 5.0;
  for (const int wanted : {1, 3, 1000}) {
    settings.candidates = wanted;
    for (const int eligible : {0, 1, 200, 399}) {
      std::vector<std::pair<double, int>> expected;
      for (int i = 0; i < eligible; ++i) {
        const double distance = (positions[i] - positions[399]).norm();
        if (distance <= 5.0) expected.emplace_back(distance, i);
      }
      std::sort(expected.begin(), expected.end());
      expected.resize(std::min<std::size_t>(expected.size(), wanted));
      const std::vector<LoopCandidate> found =
          search_radius(399, positions[399], std::span(all).first(eligible), positions, settings);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].query, 399);
        EXPECT_EQ(found[i].match, expected[i].second);
        EXPECT_EQ(found[i].distance, expected[i].first);
        EXPECT_EQ(found[i].detector, LoopCandidate::Detector::radius);
      }
    }
  }
}

TEST(RadiusSearch, CountsHeightAsDistance) {
  const std::vector<Eigen::Vector3d> positions = {{0, 0, 0}, {1, 0, 12}};
  RadiusSearchSettings settings;
  settings.radius = 10.0;
  const std::vector<LoopCandidate> found =
      search_radius(2, {0, 0, 12}, std::array{0, 1}, positions, settings);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].match, 1);
}

}  // namespace
}  // namespace lego_loam_sc
