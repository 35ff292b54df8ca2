// SPDX-License-Identifier: BSD-3-Clause
#include "sim/recorded_track.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/time.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kInterval = 0.1;            // s between the samples of the track
constexpr double kSmoothing = 2.0;           // s; shorter periods are smoothed away
constexpr double kPathSpacing = 1.0;         // m between the controls of a path
constexpr double kMinLength = 20.0;          // m
constexpr double kMaxExtent = 4000.0;        // m; the city is as large as the route
constexpr double kMaxSpeed = 60.0;           // m/s
constexpr double kMaxDuration = 4 * 3600.0;  // s

// x, y, z, yaw of each pose.
using Sample = Eigen::Vector4d;

Sample sample_of(const Pose& pose) {
  const Vector3d forward = pose.linear().col(0);
  const Vector3d t = pose.translation();
  return {t.x(), t.y(), t.z(), std::atan2(forward.y(), forward.x())};
}

void check(const Trajectory& route) {
  if (route.empty()) throw InputError("the route has no poses");
  if (seconds(route.back().stamp_ns - route.front().stamp_ns) > kMaxDuration)
    throw InputError("the route lasts longer than " + to_fixed(kMaxDuration, 0) +
                     " s; give a part of it");
  Vector3d low = route.front().pose.translation(), high = low;
  for (std::size_t i = 1; i < route.size(); ++i) {
    const Vector3d here = route[i].pose.translation();
    const double step = (here - route[i - 1].pose.translation()).norm();
    const double time = seconds(route[i].stamp_ns - route[i - 1].stamp_ns);
    const std::string place = "pose " + std::to_string(i + 1) + " of the route";
    if (time <= 0.0) throw InputError(place + " is not later than the previous one; sort the file");
    if (step > kMaxSpeed * time)
      throw InputError(place + " is " + to_fixed(step, 1) + " m from the previous one in " +
                       to_fixed(time, 1) + " s, too fast for a vehicle");
    low = low.cwiseMin(here);
    high = high.cwiseMax(here);
  }
  if ((high - low).maxCoeff() > kMaxExtent)
    throw InputError("the route is wider than " + to_fixed(kMaxExtent, 0) +
                     " m; give a part of it");
}

// Samples at equal intervals, with unwrapped yaw.
std::vector<Sample> resample(const Trajectory& route) {
  std::vector<Sample> samples;
  Sample before = sample_of(route.front().pose);
  samples.push_back(before);
  const double start = seconds(route.front().stamp_ns);
  double time_before = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) {
    Sample here = sample_of(route[i].pose);
    here[3] = before[3] + std::remainder(here[3] - before[3], 2.0 * std::numbers::pi);
    const double time = seconds(route[i].stamp_ns) - start;
    // Half a millisecond of tolerance for rounded stamps.
    for (double t = static_cast<double>(samples.size()) * kInterval; t < time + 5e-4;
         t = static_cast<double>(samples.size()) * kInterval)
      samples.emplace_back(before + (t - time_before) / (time - time_before) * (here - before));
    before = here;
    time_before = time;
  }
  return samples;
}

// Low-pass filter that keeps periods above `period` (s): least squares of the residuals and of the
// third differences (Whittaker smoother).
std::vector<Sample> smoothed(const std::vector<Sample>& samples, double period) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  const double gain = 2.0 * std::sin(std::numbers::pi * kInterval / period);
  const double weight = std::pow(gain, -6.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index row = 0; row + 3 < n; ++row) {
    const double difference[] = {-1.0, 3.0, -3.0, 1.0};
    for (int i = 0; i < 4; ++i) entries.emplace_back(row, row + i, difference[i]);
  }
  Eigen::SparseMatrix<double> D(n, n), identity(n, n);
  D.setFromTriplets(entries.begin(), entries.end());
  identity.setIdentity();
  const Eigen::SparseMatrix<double> A =
      identity + weight * Eigen::SparseMatrix<double>(D.transpose() * D);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower,
                              Eigen::NaturalOrdering<int>>
      solver(A);
  Eigen::MatrixX4d values(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) values.row(i) = samples[static_cast<std::size_t>(i)];
  const Eigen::MatrixX4d solved = solver.solve(values);
  std::vector<Sample> result;
  for (Eigen::Index i = 0; i < n; ++i) result.emplace_back(solved.row(i));
  return result;
}

}  // namespace

Track make_track(const Trajectory& route) {
  check(route);
  std::vector<Vector3d> plan;
  std::vector<double> height;
  for (const Sample& sample : smoothed(resample(route), kSmoothing)) {
    plan.emplace_back(sample[0], sample[1], sample[3]);
    height.push_back(sample[2]);
  }
  double length = 0.0;  // the smoothed track: jitter at rest adds no length
  for (std::size_t i = 1; i < plan.size(); ++i) length += (plan[i] - plan[i - 1]).head<2>().norm();
  if (length < kMinLength)
    throw InputError("the route is " + to_fixed(length, 1) + " m long, a city needs " +
                     to_fixed(kMinLength, 0) + " m");
  return {UniformSpline<Vector3d>(std::move(plan), kInterval),
          UniformSpline<double>(std::move(height), kInterval)};
}

TrackPath path_of(const Track& track) {
  constexpr int kSubsteps = 10;  // per interval
  std::vector<Vector2d> points = {track.plan.at(0.0).head<2>()};
  std::vector<double> lengths = {0.0};
  Vector2d before = points.front();
  double travelled = 0.0;
  const auto steps = static_cast<int>(std::lround(track.plan.end() / kInterval)) * kSubsteps;
  for (int i = 1; i <= steps; ++i) {
    const Vector2d here = track.plan.at(i * kInterval / kSubsteps).head<2>();
    const double step = (here - before).norm();
    while (travelled + step >= kPathSpacing * static_cast<double>(points.size())) {
      const double missing = kPathSpacing * static_cast<double>(points.size()) - travelled;
      points.emplace_back(before + missing / step * (here - before));
    }
    travelled += step;
    before = here;
    if (i % kSubsteps == 0) lengths.push_back(travelled);
  }
  return {UniformSpline<Vector2d>(std::move(points), kPathSpacing),
          UniformSpline<double>(std::move(lengths), kInterval)};
}

}  // namespace lego_loam_sc
