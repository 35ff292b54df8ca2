// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/association.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>

namespace lego_loam_sc {
namespace {

// Neighbours on each side along a row that support a plane.
constexpr int kRowNeighbours = 2;

struct Plane {
  Eigen::Vector3d mean;
  Eigen::Vector3d normal;
  double variance;  // of its points along the normal, m^2
};

// Least squares through the points; nothing when they are few or nearly collinear.
std::optional<Plane> fit_plane(const std::vector<Eigen::Vector3f>& points) {
  if (points.size() < 4) return std::nullopt;
  const Eigen::Vector3d origin = points.front().cast<double>();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3d d = p.cast<double>() - origin;
    sum += d;
    square += d * d.transpose();
  }
  const auto count = static_cast<double>(points.size());
  const Eigen::Vector3d mean = sum / count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(square / count - mean * mean.transpose());
  const Eigen::Vector3d& variance = eigen.eigenvalues();
  if (variance[1] < 0.01 * variance[2] || variance[0] > 0.1 * variance[1]) return std::nullopt;
  return Plane{origin + mean, eigen.eigenvectors().col(0), std::max(variance[0], 0.0)};
}

// Adds the point `center` and its neighbours along its row within `max_distance`.
void add_row_neighbours(const FeatureIndex& previous, int center, float max_distance,
                        std::vector<Eigen::Vector3f>& points) {
  const std::vector<FeaturePoint>& all = previous.points();
  const int count = static_cast<int>(all.size());
  const int first = std::max(center - kRowNeighbours, 0);
  const int last = std::min(center + kRowNeighbours, count - 1);
  for (int i = first; i <= last; ++i) {
    const bool is_near = all[i].row == all[center].row &&
                         (all[i].position - all[center].position).norm() <= max_distance;
    if (is_near) points.push_back(all[i].position);
  }
}

}  // namespace

std::vector<Correspondence> associate_edges(const std::vector<FeaturePoint>& edges,
                                            const FeatureIndex& previous,
                                            const Pose& T_previous_current,
                                            const OdometrySettings& settings, double range_noise) {
  const auto max_distance = static_cast<float>(settings.max_distance);
  const double weight = 1.0 / (range_noise * range_noise);
  std::vector<Correspondence> result;
  result.reserve(edges.size());
  for (const FeaturePoint& edge : edges) {
    const Eigen::Vector3d point = edge.position.cast<double>();
    const Eigen::Vector3f moved = (T_previous_current * point).cast<float>();
    const int a = previous.nearest(moved, max_distance);
    if (a < 0) continue;
    const FeaturePoint& first = previous.points()[a];
    int b = -1;
    float nearest = max_distance;
    for (int gap = 1; gap <= settings.max_row_gap; ++gap) {
      for (const int row : {first.row - gap, first.row + gap}) {
        const int other = previous.nearest_in_row(moved, row, nearest);
        if (other < 0) continue;
        b = other;
        nearest = (previous.points()[other].position - moved).norm();
      }
    }
    if (b < 0) continue;
    const Eigen::Vector3d anchor = first.position.cast<double>();
    const Eigen::Vector3d direction = previous.points()[b].position.cast<double>() - anchor;
    const double length = direction.norm();
    if (length < 1e-3) continue;
    result.push_back({Correspondence::Kind::line, point, anchor, direction / length, weight});
  }
  return result;
}

std::vector<Correspondence> associate_planars(const std::vector<FeaturePoint>& planars,
                                              const FeatureIndex& previous,
                                              const Pose& T_previous_current,
                                              const OdometrySettings& settings,
                                              double range_noise) {
  const auto max_distance = static_cast<float>(settings.max_distance);
  std::vector<Correspondence> result;
  result.reserve(planars.size());
  std::vector<Eigen::Vector3f> support;
  for (const FeaturePoint& planar : planars) {
    const Eigen::Vector3d point = planar.position.cast<double>();
    const Eigen::Vector3f moved = (T_previous_current * point).cast<float>();
    const int a = previous.nearest(moved, max_distance);
    if (a < 0) continue;
    const int row = previous.points()[a].row;
    support.clear();
    add_row_neighbours(previous, a, max_distance, support);
    const std::size_t on_row = support.size();
    for (const int direction : {-1, 1}) {
      for (int gap = 1; gap <= settings.max_row_gap; ++gap) {
        const int other = previous.nearest_in_row(moved, row + direction * gap, max_distance);
        if (other < 0) continue;
        add_row_neighbours(previous, other, max_distance, support);
        break;
      }
    }
    if (support.size() == on_row) continue;  // points of a single row are collinear
    const std::optional<Plane> plane = fit_plane(support);
    if (!plane) continue;
    const double weight = 1.0 / (range_noise * range_noise + plane->variance);
    result.push_back({Correspondence::Kind::plane, point, plane->mean, plane->normal, weight});
  }
  return result;
}

}  // namespace lego_loam_sc
