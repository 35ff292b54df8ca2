// SPDX-License-Identifier: BSD-3-Clause
#include "eval/errors.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace lego_loam_sc {
namespace {

using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

Statistics statistics(std::vector<double> errors) {
  Statistics result;
  std::sort(errors.begin(), errors.end());
  for (const double error : errors) {
    result.mean += error;
    result.rmse += error * error;
  }
  const auto count = static_cast<double>(errors.size());
  const std::size_t middle = errors.size() / 2;
  result.mean /= count;
  result.rmse = std::sqrt(result.rmse / count);
  result.median =
      errors.size() % 2 == 1 ? errors[middle] : 0.5 * (errors[middle - 1] + errors[middle]);
  result.min = errors.front();
  result.max = errors.back();
  return result;
}

// Path length up to each pose.
std::vector<double> path_lengths(std::span<const PosePair> pairs, Pose PosePair::* which) {
  std::vector<double> lengths(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i)
    lengths[i] = lengths[i - 1] +
                 ((pairs[i].*which).translation() - (pairs[i - 1].*which).translation()).norm();
  return lengths;
}

Statistics position_errors(std::span<const PosePair> pairs, const Pose& T_truth_estimate) {
  std::vector<double> errors;
  for (const PosePair& pair : pairs)
    errors.push_back(
        (T_truth_estimate * pair.estimate.translation() - pair.truth.translation()).norm());
  return statistics(std::move(errors));
}

// The error of the estimated motion from pose a to pose b, in the frame of the true pose b.
Pose motion_error(const PosePair& a, const PosePair& b) {
  return (a.truth.inverse() * b.truth).inverse() * (a.estimate.inverse() * b.estimate);
}

RelativeError relative_error(std::span<const PosePair> pairs, const IndexPairs& motions) {
  std::vector<double> translation;
  std::vector<double> rotation_deg;
  for (const auto& [from, to] : motions) {
    const Pose error = motion_error(pairs[from], pairs[to]);
    translation.push_back(error.translation().norm());
    rotation_deg.push_back(degrees(rotation_angle(error)));
  }
  return {statistics(std::move(translation)), statistics(std::move(rotation_deg))};
}

IndexPairs consecutive(std::size_t count) {
  IndexPairs motions;
  for (std::size_t i = 1; i < count; ++i) motions.emplace_back(i - 1, i);
  return motions;
}

// Consecutive segments, each up to the first pose that is at least 1 m down the path.
IndexPairs metre_by_metre(const std::vector<double>& lengths) {
  IndexPairs motions;
  std::size_t start = 0;
  for (std::size_t i = 1; i < lengths.size(); ++i) {
    if (lengths[i] - lengths[start] < 1.0) continue;
    motions.emplace_back(start, i);
    start = i;
  }
  return motions;
}

std::optional<KittiError> kitti_error(std::span<const PosePair> pairs,
                                      const std::vector<double>& lengths) {
  constexpr std::size_t kStep = 10;
  KittiError result;
  for (std::size_t first = 0; first < pairs.size(); first += kStep) {
    for (int length = 100; length <= 800; length += 100) {
      // As in the KITTI devkit, a segment ends at the first pose beyond its length.
      const auto last = std::upper_bound(lengths.begin(), lengths.end(), lengths[first] + length);
      if (last == lengths.end()) break;
      const Pose error =
          motion_error(pairs[first], pairs[static_cast<std::size_t>(last - lengths.begin())]);
      result.translation_percent += 100.0 * error.translation().norm() / length;
      result.rotation_deg_per_100m += 100.0 * degrees(rotation_angle(error)) / length;
      ++result.segments;
    }
  }
  if (result.segments == 0) return std::nullopt;
  result.translation_percent /= static_cast<double>(result.segments);
  result.rotation_deg_per_100m /= static_cast<double>(result.segments);
  return result;
}

EndError end_error(const PosePair& first, const PosePair& last) {
  const Pose truth = first.truth.inverse() * last.truth;
  const Pose estimate = first.estimate.inverse() * last.estimate;
  return {estimate.translation() - truth.translation(),
          degrees(rotation_angle(truth.inverse() * estimate))};
}

}  // namespace

Pose align(std::span<const PosePair> pairs) {
  Eigen::Vector3d truth_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d estimate_mean = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) {
    truth_mean += pair.truth.translation() / static_cast<double>(pairs.size());
    estimate_mean += pair.estimate.translation() / static_cast<double>(pairs.size());
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const PosePair& pair : pairs)
    covariance += (pair.truth.translation() - truth_mean) *
                  (pair.estimate.translation() - estimate_mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();  // S of eq. (43): a rotation, no reflection
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;

  Pose T_truth_estimate = Pose::Identity();
  T_truth_estimate.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  T_truth_estimate.translation() = truth_mean - T_truth_estimate.linear() * estimate_mean;
  return T_truth_estimate;
}

TrajectoryError evaluate(std::span<const PosePair> pairs) {
  const std::vector<double> truth_lengths = path_lengths(pairs, &PosePair::truth);
  const IndexPairs metres = metre_by_metre(truth_lengths);
  const auto distance = [](const Pose& a, const Pose& b) {
    return (a.translation() - b.translation()).norm();
  };
  TrajectoryError result;
  result.pairs = pairs.size();
  result.truth_length = truth_lengths.back();
  result.estimate_length = path_lengths(pairs, &PosePair::estimate).back();
  result.ate = position_errors(pairs, align(pairs));
  result.ate_unaligned = position_errors(pairs, Pose::Identity());
  result.rpe_frame = relative_error(pairs, consecutive(pairs.size()));
  if (!metres.empty()) result.rpe_metre = relative_error(pairs, metres);
  result.kitti = kitti_error(pairs, truth_lengths);
  result.end = end_error(pairs.front(), pairs.back());
  result.truth_first_to_last = distance(pairs.front().truth, pairs.back().truth);
  result.estimate_first_to_last = distance(pairs.front().estimate, pairs.back().estimate);
  return result;
}

}  // namespace lego_loam_sc
