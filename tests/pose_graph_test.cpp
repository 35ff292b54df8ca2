// SPDX-License-Identifier: BSD-3-Clause
#include "graph/pose_graph.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dense_pose_graph.hpp"

namespace lego_loam_sc {
namespace {

Matrix6 diagonal_covariance(double sigma, double sigma_deg) {
  Vector6 variances;
  variances.head<3>().setConstant(sigma * sigma);
  variances.tail<3>().setConstant(radians(sigma_deg) * radians(sigma_deg));
  return variances.asDiagonal();
}

const Matrix6 kOdometryCovariance = diagonal_covariance(0.01, 0.05);
const Matrix6 kLoopCovariance = diagonal_covariance(0.05, 0.2);

Vector6 sample(const Matrix6& covariance, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Vector6 noise;
  for (double& n : noise) n = normal(random);
  return covariance.llt().matrixL() * noise;
}

// Poses 1 m apart round a square and on along its first sides, with some roll and pitch.
std::vector<Pose> square_path(int count, int side, const Pose& start) {
  std::vector<Pose> truth;
  for (int i = 0; i < count; ++i) {
    const int corner = (i / side) % 4;
    const double along = i % side;
    const Pose corners[] = {Pose(Eigen::Translation3d(along, 0, 0)),
                            Pose(Eigen::Translation3d(side, along, 0)),
                            Pose(Eigen::Translation3d(side - along, side, 0)),
                            Pose(Eigen::Translation3d(0, side - along, 0))};
    Pose pose = corners[corner];
    pose.linear() =
        rotation_from_rpy(0.02 * std::sin(0.3 * i), 0.03 * std::cos(0.2 * i), 0.5 * M_PI * corner);
    truth.push_back(start * pose);
  }
  return truth;
}

PoseEdge measure(const std::vector<Pose>& truth, int from, int to, const Matrix6& covariance,
                 const Vector6& error) {
  return {from, to, truth[from].inverse() * truth[to] * exp_se3(error), covariance};
}

GraphSettings exact() {
  GraphSettings settings;
  settings.precision = 1e-6;
  return settings;
}

PoseGraph chain(const std::vector<Pose>& truth, const Vector6& bias, std::mt19937& random,
                const GraphSettings& settings = exact()) {
  PoseGraph graph(settings);
  graph.add_first(truth[0]);
  for (int i = 1; i < static_cast<int>(truth.size()); ++i)
    graph.add_key_frame(
        measure(truth, i - 1, i, kOdometryCovariance, bias + sample(kOdometryCovariance, random)));
  return graph;
}

void add_true_loop(PoseGraph& graph, const std::vector<Pose>& truth, int from, int to) {
  graph.add_loop(measure(truth, from, to, kLoopCovariance, Vector6::Zero()));
}

double largest_distance(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i].translation() - b[i].translation()).norm());
  return largest;
}

Vector6 bias_of(double z, double pitch_deg, double yaw_deg) {
  Vector6 bias = Vector6::Zero();
  bias(2) = z;
  bias(4) = radians(pitch_deg);
  bias(5) = radians(yaw_deg);
  return bias;
}

TEST(PoseGraph, WithoutLoopsFollowsTheOdometryExactly) {
  std::mt19937 random(1);
  const std::vector<Pose> truth = square_path(30, 10, Pose::Identity());
  PoseGraph graph = chain(truth, Vector6::Zero(), random);
  const std::vector<Pose> before = graph.poses();
  graph.optimise();
  ASSERT_EQ(graph.size(), 30u);
  Pose composed = truth[0];
  for (std::size_t i = 1; i < graph.size(); ++i) {
    composed = composed * graph.odometry_edges()[i - 1].T_from_to;
    EXPECT_TRUE(graph.poses()[i].isApprox(composed, 1e-12));
    EXPECT_EQ(graph.poses()[i].matrix(), before[i].matrix());
  }
}

TEST(PoseGraph, RepairsTheDriftOfASquareWithALoop) {
  std::mt19937 random(2);
  const std::vector<Pose> truth = square_path(201, 50, Pose::Identity());
  PoseGraph graph = chain(truth, bias_of(0.0, 0.0, 0.1), random);
  const double before = largest_distance(graph.poses(), truth);
  add_true_loop(graph, truth, 0, 200);
  graph.optimise();
  EXPECT_GT(before, 10.0);
  EXPECT_LT(largest_distance(graph.poses(), truth), before / 10.0);
}

TEST(PoseGraph, ClosesTwelveMetresOfDriftInHeightDespiteTheKernel) {
  const std::vector<Pose> truth = square_path(201, 50, Pose::Identity());
  const auto solve = [&](double kernel) {
    std::mt19937 random(3);
    GraphSettings settings = exact();
    settings.loop_kernel = kernel;
    PoseGraph graph = chain(truth, bias_of(0.06, 0.0, 0.0), random, settings);
    EXPECT_GT(std::abs(graph.poses()[200].translation().z()), 11.0);
    add_true_loop(graph, truth, 0, 200);
    graph.optimise();
    return graph.poses();
  };
  const std::vector<Pose> repaired = solve(3.0);
  EXPECT_LT((repaired[200].translation() - truth[200].translation()).norm(), 0.25);
  EXPECT_LT(largest_distance(repaired, solve(0.0)), 0.01);
}

TEST(PoseGraph, AgreesWithADenseSolutionOverAllPoses) {
  std::mt19937 random(4);
  GraphSettings settings = exact();
  settings.loop_kernel = 0.0;
  const Pose start(Eigen::Translation3d(3, -2, 1) *
                   Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  const std::vector<Pose> truth = square_path(46, 8, start);
  PoseGraph graph = chain(truth, bias_of(0.05, 0.4, 0.5), random, settings);
  Matrix6 skewed = kLoopCovariance;  // the six numbers depend on each other
  skewed(0, 5) = skewed(5, 0) = 0.5 * 0.05 * radians(0.2);
  skewed(1, 2) = skewed(2, 1) = 0.3 * 0.05 * 0.05;
  graph.add_loop(measure(truth, 1, 33, skewed, sample(skewed, random)));
  graph.optimise();
  graph.add_loop(measure(truth, 40, 8, skewed, sample(skewed, random)));
  graph.add_loop(measure(truth, 5, 37, skewed, sample(skewed, random)));
  graph.optimise();

  std::vector<PoseEdge> edges = graph.odometry_edges();
  edges.insert(edges.end(), graph.loop_edges().begin(), graph.loop_edges().end());
  const std::vector<Pose> expected = dense_optimum(truth, edges);
  EXPECT_GT(largest_distance(graph.poses(), truth), 1e-2);
  EXPECT_LT(largest_distance(graph.poses(), expected), 1e-6);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LT(rotation_angle(expected[i].inverse() * graph.poses()[i]), 1e-6);
}

// Loop after loop, as a drive finds them.
TEST(PoseGraph, IsExactToTheMillimetreUnlessMoreIsAskedFor) {
  const auto solve = [](const GraphSettings& settings) {
    std::mt19937 random(9);
    const std::vector<Pose> truth = square_path(1000, 50, Pose::Identity());
    PoseGraph graph(settings);
    graph.add_first(truth[0]);
    for (int i = 1; i < 1000; ++i) {
      graph.add_key_frame(
          measure(truth, i - 1, i, kOdometryCovariance, sample(kOdometryCovariance, random)));
      if (i < 200 || i % 20 != 0) continue;
      graph.add_loop(measure(truth, i - 200, i, kLoopCovariance, sample(kLoopCovariance, random)));
      graph.optimise();
    }
    return graph.poses();
  };
  EXPECT_LT(largest_distance(solve({}), solve(exact())), 1e-3);
}

TEST(PoseGraph, IsAsExactFarFromTheOrigin) {
  const auto solve = [](const Pose& start) {
    std::mt19937 random(5);
    const std::vector<Pose> truth = square_path(120, 25, start);
    PoseGraph graph = chain(truth, bias_of(0.01, 0.05, 0.1), random);
    add_true_loop(graph, truth, 4, 104);
    add_true_loop(graph, truth, 15, 115);
    graph.optimise();
    std::vector<Pose> from_start;
    for (const Pose& pose : graph.poses()) from_start.push_back(start.inverse() * pose);
    return from_start;
  };
  const Pose far(Eigen::Translation3d(1e5, -1e5, 300) *
                 Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()));
  EXPECT_LT(largest_distance(solve(Pose::Identity()), solve(far)), 1e-6);
}

TEST(PoseGraph, ShowsAWrongLoopAndForgetsItWhenRemoved) {
  std::mt19937 random(6);
  const std::vector<Pose> truth = square_path(260, 50, Pose::Identity());
  PoseGraph graph = chain(truth, bias_of(0.0, 0.0, 0.02), random);
  for (int i = 0; i < 60; i += 12) add_true_loop(graph, truth, i, i + 200);
  graph.optimise();
  const std::vector<Pose> without = graph.poses();

  PoseEdge wrong = measure(truth, 30, 160, kLoopCovariance, Vector6::Zero());
  wrong.T_from_to = Pose::Identity();  // two corridors that look the same
  graph.add_loop(wrong);
  graph.optimise();
  const std::size_t last = graph.loop_edges().size() - 1;
  EXPECT_GT(graph.loop_chi(last), 50.0);
  for (std::size_t i = 0; i < last; ++i) EXPECT_LT(graph.loop_chi(i), graph.loop_chi(last) / 10.0);
  EXPECT_GT(largest_distance(graph.poses(), without), 0.1);

  graph.remove_loop(last);
  graph.optimise();
  EXPECT_EQ(graph.loop_edges().size(), last);
  EXPECT_LT(largest_distance(graph.poses(), without), 1e-5);
}

TEST(PoseGraph, IsOdometryAgainWhenItsOnlyLoopIsRemoved) {
  std::mt19937 random(7);
  const std::vector<Pose> truth = square_path(60, 14, Pose::Identity());
  PoseGraph graph = chain(truth, bias_of(0.0, 0.0, 0.1), random);
  const std::vector<Pose> odometry = graph.poses();
  add_true_loop(graph, truth, 0, 56);
  graph.optimise();
  EXPECT_GT(largest_distance(graph.poses(), odometry), 0.1);
  graph.remove_loop(0);
  graph.optimise();
  EXPECT_LT(largest_distance(graph.poses(), odometry), 1e-9);
}

TEST(PoseGraph, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto solve = [](int threads) {
    std::vector<Pose> poses;
    tbb::task_arena(threads).execute([&] {
      std::mt19937 random(8);
      const std::vector<Pose> truth = square_path(600, 50, Pose::Identity());
      PoseGraph graph = chain(truth, bias_of(0.01, 0.0, 0.02), random);
      for (int i = 200; i < 600; i += 7) {
        graph.add_loop(
            measure(truth, i % 200, i, kLoopCovariance, sample(kLoopCovariance, random)));
        if (i % 3 == 0) graph.optimise();
      }
      graph.optimise();
      poses = graph.poses();
    });
    return poses;
  };
  const std::vector<Pose> one = solve(1);
  const std::vector<Pose> two = solve(2);
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i].matrix(), two[i].matrix()) << i;
}

TEST(PoseGraph, RefusesEdgesThatMakeNoSense) {
  PoseGraph graph{GraphSettings{}};
  const PoseEdge step{0, 1, Pose(Eigen::Translation3d(1, 0, 0)), kOdometryCovariance};
  EXPECT_THROW(graph.add_key_frame(step), std::invalid_argument);
  graph.add_first(Pose::Identity());
  EXPECT_THROW(graph.add_first(Pose::Identity()), std::invalid_argument);
  graph.add_key_frame(step);
  EXPECT_THROW(graph.add_key_frame(step), std::invalid_argument);
  EXPECT_THROW(graph.add_loop({0, 0, Pose::Identity(), kLoopCovariance}), std::invalid_argument);
  EXPECT_THROW(graph.add_loop({0, 2, Pose::Identity(), kLoopCovariance}), std::invalid_argument);
  EXPECT_THROW(graph.add_loop({0, 1, Pose::Identity(), Matrix6::Zero()}), std::invalid_argument);
  Pose broken = Pose::Identity();
  broken.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(graph.add_loop({0, 1, broken, kLoopCovariance}), std::invalid_argument);
  EXPECT_THROW(graph.remove_loop(0), std::invalid_argument);
  EXPECT_EQ(graph.size(), 2u);
}

}  // namespace
}  // namespace lego_loam_sc
