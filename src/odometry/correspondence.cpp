// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/correspondence.hpp"

#include <algorithm>
#include <cmath>

namespace lego_loam_sc {
namespace {

using Matrix36 = Eigen::Matrix<double, 3, 6>;

// Offset from the plane along its normal, or from the line across it.
Eigen::Vector3d residual(const Correspondence& c, const Eigen::Vector3d& transformed) {
  const Eigen::Vector3d offset = transformed - c.anchor;
  const Eigen::Vector3d along = c.direction * c.direction.dot(offset);
  return c.kind == Correspondence::Kind::plane ? along : Eigen::Vector3d(offset - along);
}

}  // namespace

double distance(const Correspondence& c, const Pose& T_target_source) {
  return residual(c, T_target_source * c.point).norm();
}

double robust_weight(double distance, double scale) {
  const double ratio = distance / scale;
  return 1.0 / (1.0 + ratio * ratio);
}

double robust_scale(std::span<const Correspondence> correspondences, const Pose& T_target_source,
                    double factor, double minimum, double maximum) {
  if (correspondences.empty()) return maximum;
  std::vector<double> distances;
  distances.reserve(correspondences.size());
  for (const Correspondence& c : correspondences)
    distances.push_back(distance(c, T_target_source));
  const auto middle = distances.begin() + distances.size() / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return std::clamp(factor * 1.4826 * *middle, minimum, maximum);
}

NormalEquations<6> normal_equations(std::span<const Correspondence> correspondences,
                                    const Pose& T_target_source, double scale) {
  NormalEquations<6> sum;
  for (const Correspondence& c : correspondences) {
    const Eigen::Vector3d rotated = T_target_source.linear() * c.point;
    const Eigen::Vector3d transformed = rotated + T_target_source.translation();
    if (c.kind == Correspondence::Kind::plane) {
      const double d = c.direction.dot(transformed - c.anchor);
      Vector6 row;
      row << c.direction, rotated.cross(c.direction);
      const double weight = c.weight * robust_weight(d, scale);
      sum.H.noalias() += (weight * row) * row.transpose();
      sum.g += weight * d * row;
      sum.cost += 0.5 * c.weight * scale * scale * std::log1p(d * d / (scale * scale));
    } else {
      const Eigen::Vector3d e = residual(c, transformed);
      const double squared = e.squaredNorm();
      const Eigen::Matrix3d across =
          Eigen::Matrix3d::Identity() - c.direction * c.direction.transpose();
      Matrix36 rows;
      rows.leftCols<3>() = across;
      rows.rightCols<3>() = -across * skew(rotated);
      const double weight = c.weight * robust_weight(std::sqrt(squared), scale);
      sum.H.noalias() += (weight * rows.transpose()).lazyProduct(rows);
      sum.g += weight * rows.transpose() * e;
      sum.cost += 0.5 * c.weight * scale * scale * std::log1p(squared / (scale * scale));
    }
  }
  return sum;
}

}  // namespace lego_loam_sc
