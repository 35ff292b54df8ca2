// SPDX-License-Identifier: BSD-3-Clause
#include "loop/scan_context.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/pose.hpp"
#include "loop/scan_context_index.hpp"

namespace lego_loam_sc {
namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr double kHeight = 1.8;
constexpr double kBin = 2.0 * M_PI / 60.0;

// Poles and house fronts round the origin, on the ground at z = -kHeight.
Points random_world(std::mt19937& random) {
  std::uniform_real_distribution<float> angle(-3.14f, 3.14f);
  std::uniform_real_distribution<float> radius(3.0f, 75.0f);
  std::uniform_real_distribution<float> height(0.5f, 12.0f);
  Points points;
  for (int object = 0; object < 150; ++object) {
    const float azimuth = angle(random);
    const float distance = radius(random);
    const float top = height(random);
    for (float along = -3.0f; along <= 3.0f; along += 0.25f)
      points.emplace_back(distance * std::cos(azimuth) - along * std::sin(azimuth),
                          distance * std::sin(azimuth) + along * std::cos(azimuth),
                          top - static_cast<float>(kHeight));
  }
  return points;
}

Points transformed(const Points& points, const Pose& T_target_source) {
  Points result;
  for (const Eigen::Vector3f& p : points)
    result.push_back((T_target_source * p.cast<double>()).cast<float>());
  return result;
}

Pose rotation_z(double yaw) {
  return Pose(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

// Equations (2) and (3) as they stand: one pass over all points for every bin.
Eigen::MatrixXd naive_bins(const Points& points, const ScanContextSettings& s) {
  Eigen::MatrixXd bins = Eigen::MatrixXd::Zero(s.rings, s.sectors);
  for (int i = 0; i < s.rings; ++i)
    for (int j = 0; j < s.sectors; ++j)
      for (const Eigen::Vector3f& p : points) {
        const double radius = std::hypot(double{p.x()}, double{p.y()});
        const double turn = std::atan2(double{p.y()}, double{p.x()}) / (2.0 * M_PI);
        const double sector = (turn - std::floor(turn)) * s.sectors;
        const double ring = radius / s.max_radius * s.rings;
        if (ring >= i && ring < i + 1 && sector >= j && sector < j + 1)
          bins(i, j) = std::max(bins(i, j), p.z() + kHeight);
      }
  return bins;
}

// Equation (4) with the candidate's columns shifted by n.
double naive_distance(const Eigen::MatrixXd& query, const Eigen::MatrixXd& candidate, int n) {
  const int sectors = static_cast<int>(query.cols());
  double sum = 0.0;
  int compared = 0;
  int common = 0;
  for (int j = 0; j < sectors; ++j) {
    const Eigen::VectorXd a = query.col(j);
    const Eigen::VectorXd b = candidate.col((j - n + sectors) % sectors);
    if (a.norm() == 0.0 && b.norm() == 0.0) continue;
    ++compared;
    if (a.norm() == 0.0 || b.norm() == 0.0) {
      sum += 1.0;
      continue;
    }
    ++common;
    sum += 1.0 - a.dot(b) / (a.norm() * b.norm());
  }
  return 2 * common < sectors ? 1.0 : sum / compared;
}

TEST(ScanContext, DistanceAndShiftAgreeWithTheEquationsWrittenOut) {
  std::mt19937 random(1);
  ScanContextSettings settings;
  settings.rings = 13;
  settings.sectors = 31;
  settings.max_radius = 60.0;
  for (int trial = 0; trial < 8; ++trial) {
    Points a = random_world(random);
    Points b = transformed(a, rotation_z(0.9 * trial) * Eigen::Translation3d(0.5 * trial, 1.0, 0));
    // Leave whole columns out, so that all cases of empty columns appear.
    std::erase_if(a, [&](const auto& p) { return p.x() < -5.0f * static_cast<float>(trial); });
    std::erase_if(b, [](const auto& p) { return p.y() > 0.0f && p.y() > 2.0f * p.x(); });
    const Eigen::MatrixXd query = naive_bins(a, settings);
    const Eigen::MatrixXd candidate = naive_bins(b, settings);
    std::vector<double> distances;
    for (int n = 0; n < settings.sectors; ++n)
      distances.push_back(naive_distance(query, candidate, n));
    const auto lowest = std::min_element(distances.begin(), distances.end());
    const ScanContextMatch match =
        compare(make_scan_context(a, kHeight, settings), make_scan_context(b, kHeight, settings));
    EXPECT_NEAR(match.distance, *lowest, 1e-5);
    EXPECT_EQ(match.shift, lowest - distances.begin());
  }
}

TEST(ScanContext, RingKeyHoldsTheMeanHeightOfEachRing) {
  std::mt19937 random(2);
  const ScanContextSettings settings;
  const Points points = random_world(random);
  const ScanContext context = make_scan_context(points, kHeight, settings);
  const Eigen::VectorXd means = naive_bins(points, settings).rowwise().mean();
  ASSERT_EQ(context.ring_key.size(), 20u);
  for (int ring = 0; ring < 20; ++ring) EXPECT_NEAR(context.ring_key[ring], means(ring), 1e-4);
}

TEST(ScanContext, IsAtDistanceZeroFromItself) {
  std::mt19937 random(3);
  const ScanContext context = make_scan_context(random_world(random), kHeight, {});
  EXPECT_NEAR(compare(context, context).distance, 0.0, 1e-5);
  EXPECT_EQ(compare(context, context).shift, 0);
}

TEST(ScanContext, DoesNotChangeWithARotationByWholeBins) {
  std::mt19937 random(4);
  const ScanContextSettings settings;
  // Points in the middle of their sectors: rounding cannot carry them into the next one.
  Points points = random_world(random);
  for (Eigen::Vector3f& p : points) {
    const double azimuth = (std::floor(std::atan2(p.y(), p.x()) / kBin) + 0.5) * kBin;
    const double radius = p.head<2>().norm();
    p.x() = static_cast<float>(radius * std::cos(azimuth));
    p.y() = static_cast<float>(radius * std::sin(azimuth));
  }
  const ScanContext candidate = make_scan_context(points, kHeight, settings);
  for (const int bins : {1, 17, 30, 59}) {
    // A vehicle that has turned left by `bins` sees everything that much further to the right.
    const ScanContext query =
        make_scan_context(transformed(points, rotation_z(-bins * kBin)), kHeight, settings);
    const ScanContextMatch match = compare(query, candidate);
    EXPECT_NEAR(match.distance, 0.0, 1e-5);
    EXPECT_EQ(match.shift, 60 - bins);
    for (int ring = 0; ring < settings.rings; ++ring)
      EXPECT_NEAR(query.ring_key[ring], candidate.ring_key[ring], 1e-4);
  }
}

TEST(ScanContext, YawTurnsTheQueryIntoTheCandidateFarFromTheOrigin) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::uniform_real_distribution<double> small(-0.3, 0.3);
  for (int trial = 0; trial < 30; ++trial) {
    const Pose T_map_candidate = Eigen::Translation3d(8e4, -5e4, 40) * rotation_z(angle(random));
    const double yaw = angle(random);
    const Pose T_candidate_query =
        Eigen::Translation3d(small(random), small(random), 0) * rotation_z(yaw);
    const Pose T_map_query = T_map_candidate * T_candidate_query;
    const Points seen_by_candidate = random_world(random);
    const Points seen_by_query =
        transformed(seen_by_candidate, T_map_query.inverse() * T_map_candidate);
    const ScanContextMatch match = compare(make_scan_context(seen_by_query, kHeight, {}),
                                           make_scan_context(seen_by_candidate, kHeight, {}));
    EXPECT_LT(match.distance, 0.3);
    EXPECT_LT(std::abs(std::remainder(match.yaw - yaw, 2.0 * M_PI)), 0.5 * kBin) << trial;
  }
}

TEST(ScanContext, YawIsFinerThanTheSectors) {
  std::mt19937 random(6);
  double with_parabola = 0.0;  // sums of errors
  double whole_bins = 0.0;
  for (int trial = 0; trial < 40; ++trial) {
    const Points points = random_world(random);
    const double yaw = 0.173 * trial - M_PI;
    const ScanContextMatch match =
        compare(make_scan_context(transformed(points, rotation_z(-yaw)), kHeight, {}),
                make_scan_context(points, kHeight, {}));
    with_parabola += std::abs(std::remainder(match.yaw - yaw, 2.0 * M_PI));
    whole_bins += std::abs(std::remainder(-match.shift * kBin - yaw, 2.0 * M_PI));
  }
  EXPECT_LT(with_parabola, 0.5 * whole_bins);
}

TEST(ScanContext, TellsPlacesApart) {
  std::mt19937 random(7);
  const ScanContext here = make_scan_context(random_world(random), kHeight, {});
  for (int trial = 0; trial < 10; ++trial)
    EXPECT_GT(compare(make_scan_context(random_world(random), kHeight, {}), here).distance, 0.4);
}

TEST(ScanContext, LittleEvidenceIsNoMatch) {
  std::mt19937 random(8);
  const ScanContext world = make_scan_context(random_world(random), kHeight, {});
  const ScanContext empty = make_scan_context(Points{}, kHeight, {});
  const ScanContext one_point = make_scan_context(Points{{10, 5, 2}}, kHeight, {});
  Points half;  // 29 of 60 sectors
  for (int sector = 0; sector < 29; ++sector)
    half.emplace_back(10 * std::cos((sector + 0.5) * kBin), 10 * std::sin((sector + 0.5) * kBin),
                      1);
  const ScanContext nearly_half = make_scan_context(half, kHeight, {});
  half.emplace_back(10 * std::cos(29.5 * kBin), 10 * std::sin(29.5 * kBin), 1);
  const ScanContext just_half = make_scan_context(half, kHeight, {});
  for (const ScanContext& context : {empty, one_point, nearly_half}) {
    EXPECT_EQ(compare(context, context).distance, 1.0);
    EXPECT_EQ(compare(context, world).distance, 1.0);
    EXPECT_EQ(compare(world, context).distance, 1.0);
  }
  EXPECT_NEAR(compare(just_half, just_half).distance, 0.0, 1e-5);
}

TEST(ScanContext, LeavesOutPointsThatAreBrokenFarOrAtTheSensor) {
  std::mt19937 random(9);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Points points = random_world(random);
  const ScanContext clean = make_scan_context(points, kHeight, {});
  for (const Eigen::Vector3f& bad :
       {Eigen::Vector3f(kNan, 1, 5), Eigen::Vector3f(10, 10, kNan),
        Eigen::Vector3f(10, 10, kInfinity), Eigen::Vector3f(kInfinity, 1, 50),
        Eigen::Vector3f(80, 0, 50), Eigen::Vector3f(3e38f, 3e38f, 1), Eigen::Vector3f(0, 0, 30),
        Eigen::Vector3f(10, 10, -50)})
    points.push_back(bad);
  const ScanContext dirty = make_scan_context(points, kHeight, {});
  EXPECT_EQ(dirty.columns, clean.columns);
  EXPECT_EQ(dirty.ring_key, clean.ring_key);
}

TEST(ScanContextIndex, FindsWhatASearchThroughAllSortedKeysFinds) {
  std::mt19937 random(10);
  ScanContextSettings settings;
  settings.candidates = 4;
  settings.threshold = 0.9;
  ScanContextIndex index(settings);
  std::vector<ScanContext> contexts;
  for (int i = 0; i < 45; ++i) {
    // Every fifth key frame is the one five before once more: equal keys and equal distances.
    contexts.push_back(i % 5 == 4 && i > 5 ? contexts[i - 5]
                                           : make_scan_context(random_world(random), kHeight, {}));
    if (i % 7 != 3) index.add(i, contexts.back());
  }
  for (const int eligible : {0, 1, 7, 8, 30, 45}) {
    std::vector<std::pair<double, int>> keys;
    for (int i = 0; i < eligible; ++i) {
      if (i % 7 == 3) continue;
      double squared = 0.0;
      for (int ring = 0; ring < settings.rings; ++ring)
        squared += std::pow(contexts[i].ring_key[ring] - contexts[44].ring_key[ring], 2);
      keys.emplace_back(squared, i);
    }
    std::sort(keys.begin(), keys.end());
    keys.resize(std::min<std::size_t>(keys.size(), 4));
    std::vector<std::pair<double, int>> expected;
    for (const auto& [squared, i] : keys) {
      const double distance = compare(contexts[44], contexts[i]).distance;
      if (distance < settings.threshold) expected.emplace_back(distance, i);
    }
    std::sort(expected.begin(), expected.end());
    const std::vector<LoopCandidate> found = index.search(44, contexts[44], eligible);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].match, expected[i].second);
      EXPECT_EQ(found[i].distance, expected[i].first);
    }
  }
}

TEST(ScanContextIndex, GivesNothingAtOrAboveTheThreshold) {
  std::mt19937 random(11);
  ScanContextSettings settings;
  settings.threshold = 0.2;
  ScanContextIndex index(settings);
  const Points place = random_world(random);
  index.add(0, make_scan_context(random_world(random), kHeight, settings));
  index.add(1, make_scan_context(place, kHeight, settings));
  index.add(2, make_scan_context(Points{}, kHeight, settings));
  const std::vector<LoopCandidate> found =
      index.search(3, make_scan_context(transformed(place, rotation_z(2.0)), kHeight, settings), 3);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].detector, LoopCandidate::Detector::scan_context);
  EXPECT_EQ(found[0].query, 3);
  EXPECT_EQ(found[0].match, 1);
  EXPECT_NEAR(found[0].yaw, -2.0, 0.5 * kBin);
}

TEST(ScanContextIndex, RefusesAnotherNumberOfBins) {
  const ScanContextSettings other{.rings = 40};
  EXPECT_THROW(ScanContextIndex({}).add(0, make_scan_context(Points{}, kHeight, other)),
               std::invalid_argument);
}

}  // namespace
}  // namespace lego_loam_sc
