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
  result.degenerate_translations =
      static_cast<int>((result.translation.array() < min_strength).count());
  result.degenerate_rotations = static_cast<int>((result.rotation.array() < min_strength).count());
  return result;
}

Vector6 degenerate_component(const Localizability& l, const Vector6& delta) {
  Vector6 component = Vector6::Zero();
  for (int i = 0; i < l.degenerate_translations; ++i)
    component.head<3>() +=
        l.translation_axes.col(i) * l.translation_axes.col(i).dot(delta.head<3>());
  for (int i = 0; i < l.degenerate_rotations; ++i)
    component.tail<3>() += l.rotation_axes.col(i) * l.rotation_axes.col(i).dot(delta.tail<3>());
  return component;
}

Matrix6 degenerate_projection(const Localizability& l, double translation_weight,
                              double rotation_weight) {
  Matrix6 projection = Matrix6::Zero();
  for (int i = 0; i < l.degenerate_translations; ++i)
    projection.topLeftCorner<3, 3>() +=
        translation_weight * l.translation_axes.col(i) * l.translation_axes.col(i).transpose();
  for (int i = 0; i < l.degenerate_rotations; ++i)
    projection.bottomRightCorner<3, 3>() +=
        rotation_weight * l.rotation_axes.col(i) * l.rotation_axes.col(i).transpose();
  return projection;
}

}  // namespace lego_loam_sc
