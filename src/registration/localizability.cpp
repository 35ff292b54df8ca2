// SPDX-License-Identifier: BSD-3-Clause
#include "registration/localizability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

namespace lego_loam_sc {
namespace {

// A constraint at more than 78 degrees to a direction is noise along it.
constexpr double kMinCosine = 0.2;

double contribution(double squared_cosine) {
  return squared_cosine < kMinCosine * kMinCosine ? 0.0 : squared_cosine;
}

// The constrained part of the unit direction `v`: along the normal of a plane, across a line, all
// of it for a point.
double squared_cosine(const Correspondence& c, const Eigen::Vector3d& v) {
  const double along = c.direction.dot(v);
  return c.kind == Correspondence::Kind::plane ? along * along : 1.0 - along * along;
}

// Weakest axis first.
void sort_axes(Eigen::Vector3d& strength, Eigen::Matrix3d& axes) {
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return strength[a] < strength[b]; });
  const Eigen::Vector3d unsorted = strength;
  const Eigen::Matrix3d unsorted_axes = axes;
  for (int i = 0; i < 3; ++i) {
    strength[i] = unsorted[order[i]];
    axes.col(i) = unsorted_axes.col(order[i]);
  }
}

}  // namespace

Localizability localizability(std::span<const Correspondence> correspondences,
                              const Pose& T_target_source, double scale, double min_strength) {
  Localizability result;
  const NormalEquations<6> equations = normal_equations(correspondences, T_target_source, scale);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> translation(
      equations.H.topLeftCorner<3, 3>());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> rotation(
      equations.H.bottomRightCorner<3, 3>());
  result.translation_axes = translation.eigenvectors();
  result.rotation_axes = rotation.eigenvectors();

  for (const Correspondence& c : correspondences) {
    const double weight =
        robust_weight(c, distance(c, T_target_source), scale) / c.weight;  // at most 1
    const Eigen::Vector3d arm = (T_target_source.linear() * c.point).normalized();
    for (int i = 0; i < 3; ++i) {
      result.translation[i] +=
          weight * contribution(squared_cosine(c, result.translation_axes.col(i)));
      // A rotation about the axis moves the point along axis x arm, little when close to the axis.
      const Eigen::Vector3d movement = result.rotation_axes.col(i).cross(arm);
      const double length = movement.norm();
      if (length > 0.0)
        result.rotation[i] +=
            weight * contribution(length * length * squared_cosine(c, movement / length));
    }
  }
  sort_axes(result.translation, result.translation_axes);
  sort_axes(result.rotation, result.rotation_axes);
  const auto degenerate = [&](double strength) { return strength < min_strength; };
  for (int i = 0; i < 3; ++i) {
    result.translation_certainty[i] = degenerate(result.translation[i]) ? 0.0 : 1.0;
    result.rotation_certainty[i] = degenerate(result.rotation[i]) ? 0.0 : 1.0;
    result.degenerate_translations += degenerate(result.translation[i]);
    result.degenerate_rotations += degenerate(result.rotation[i]);
  }
  return result;
}

Vector6 degenerate_component(const Localizability& l, const Vector6& delta) {
  return degenerate_projection(l, 1.0, 1.0) * delta;
}

Matrix6 degenerate_projection(const Localizability& l, double translation_weight,
                              double rotation_weight) {
  const auto projection = [](const Eigen::Matrix3d& axes, const Eigen::Vector3d& certainty) {
    return Eigen::Matrix3d(axes * (1.0 - certainty.array()).matrix().asDiagonal() *
                           axes.transpose());
  };
  Matrix6 result = Matrix6::Zero();
  result.topLeftCorner<3, 3>() =
      translation_weight * projection(l.translation_axes, l.translation_certainty);
  result.bottomRightCorner<3, 3>() =
      rotation_weight * projection(l.rotation_axes, l.rotation_certainty);
  return result;
}

}  // namespace lego_loam_sc
