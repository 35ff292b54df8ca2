// SPDX-License-Identifier: BSD-3-Clause
#include "graph.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <numbers>
#include <random>

#include "graph/pose_graph.hpp"

namespace lego_loam_sc {
namespace {

constexpr int kKeyFrames = 20'000;  // 2 m apart
constexpr int kRound = 500;         // key frames of one round
constexpr int kLoopEvery = 39;      // key frames: 500 loops

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Pose noisy(std::mt19937& random, const Pose& pose, double metres, double rad) {
  std::normal_distribution<double> normal;
  Vector6 noise;
  for (int i = 0; i < 6; ++i) noise[i] = (i < 3 ? metres : rad) * normal(random);
  return pose * exp_se3(noise);
}

Matrix6 covariance(double metres, double rad) {
  Vector6 variance;
  variance << Eigen::Vector3d::Constant(metres * metres), Eigen::Vector3d::Constant(rad * rad);
  return variance.asDiagonal();
}

struct Cost {
  double key_frame = 0.0;   // s, mean of the last thousand
  double mean_loop = 0.0;   // s
  double worst_loop = 0.0;  // s
  int loops = 0;
};

// Round and round a circle of a kilometre, with a loop to the round before every 78 m.
Cost drive() {
  std::mt19937 random(1);
  Pose step = Pose::Identity();
  step.translation().x() = 2.0;
  step.linear() = rotation_from_rpy(0.0, 0.0, 2.0 * std::numbers::pi / kRound);
  PoseGraph graph{GraphSettings{}};
  graph.add_first(Pose::Identity());
  Cost cost;
  for (int k = 1; k < kKeyFrames; ++k) {
    auto begin = std::chrono::steady_clock::now();
    graph.add_key_frame({k - 1, k, noisy(random, step, 0.01, 1e-3), covariance(0.01, 1e-3)});
    if (k >= kKeyFrames - 1000) cost.key_frame += seconds_since(begin) / 1000.0;
    if (k < kRound || k % kLoopEvery != 0) continue;
    begin = std::chrono::steady_clock::now();
    graph.add_loop(
        {k - kRound, k, noisy(random, Pose::Identity(), 0.05, 3e-3), covariance(0.05, 3e-3)});
    graph.optimise();
    const double seconds = seconds_since(begin);
    cost.worst_loop = std::max(cost.worst_loop, seconds);
    cost.mean_loop += seconds;
    ++cost.loops;
  }
  cost.mean_loop /= cost.loops;
  return cost;
}

}  // namespace

void add_graph_benchmarks() {
  benchmark::RegisterBenchmark("graph",
                               [](benchmark::State& state) {
                                 Cost cost;
                                 for (auto _ : state) cost = drive();
                                 state.counters["loops"] = cost.loops;
                                 state.counters["key_frame_ms"] = 1e3 * cost.key_frame;
                                 state.counters["mean_loop_ms"] = 1e3 * cost.mean_loop;
                                 state.counters["worst_loop_ms"] = 1e3 * cost.worst_loop;
                               })
      ->Unit(benchmark::kSecond)
      ->Iterations(1);
}

}  // namespace lego_loam_sc
