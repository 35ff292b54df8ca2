// SPDX-License-Identifier: BSD-3-Clause
#include "sim/terrain.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSpacing = 12.0;  // m between controls; hills are larger
// What the climb between two points and the second differences of the controls weigh against each
// other: metres by which each may be off.
constexpr double kClimbError = 0.02, kBendError = 0.2;

using Weights = std::array<double, 4>;

Weights value_weights(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
          (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0, t * t * t / 6.0};
}

Weights slope_weights(double t) {
  const double s = 1.0 - t;
  return {-0.5 * s * s, -2.0 * t + 1.5 * t * t, 2.0 * s - 1.5 * s * s, 0.5 * t * t};
}

// The rows of a linear least-squares problem.
class Equations {
 public:
  explicit Equations(int unknowns) : unknowns_(unknowns) {}

  void add(int unknown, double coefficient) { entries_.emplace_back(row_, unknown, coefficient); }
  void close_row(double right_side) {
    right_.push_back(right_side);
    ++row_;
  }

  std::vector<double> solve() const {
    Eigen::SparseMatrix<double> J(row_, unknowns_);
    J.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SparseMatrix<double> A = J.transpose() * J;
    const Eigen::Map<const Eigen::VectorXd> b(right_.data(), row_);
    const Eigen::VectorXd x =
        Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(A).solve(J.transpose() * b);
    return {x.data(), x.data() + x.size()};
  }

 private:
  int unknowns_, row_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> right_;
};

}  // namespace

// The sixteen controls round a place, and the place among them, 0 to 1.
struct Terrain::Patch {
  int i, j;  // of the first
  double u, v;
};

Terrain::Terrain(const Vector2d& low, const Vector2d& high)
    : low_(low),
      nx_(static_cast<int>(std::ceil((high.x() - low.x()) / kSpacing)) + 3),
      ny_(static_cast<int>(std::ceil((high.y() - low.y()) / kSpacing)) + 3) {}

Terrain::Patch Terrain::patch_at(const Vector2d& place) const {
  const Vector2d p = (place - low_) / kSpacing;
  const double x = std::clamp(p.x(), 0.0, nx_ - 3.0), y = std::clamp(p.y(), 0.0, ny_ - 3.0);
  const int i = std::min(static_cast<int>(x), nx_ - 4), j = std::min(static_cast<int>(y), ny_ - 4);
  return {i, j, x - i, y - j};
}

double Terrain::height(const Vector2d& place) const {
  const Patch patch = patch_at(place);
  const Weights wx = value_weights(patch.u), wy = value_weights(patch.v);
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double* row = &controls_[static_cast<std::size_t>(patch.i + i) * ny_ + patch.j];
    for (int j = 0; j < 4; ++j) sum += wx[i] * wy[j] * row[j];
  }
  return sum;
}

Vector2d Terrain::slope(const Vector2d& place) const {
  const Patch patch = patch_at(place);
  const Weights wx = value_weights(patch.u), wy = value_weights(patch.v);
  const Weights dx = slope_weights(patch.u), dy = slope_weights(patch.v);
  Vector2d sum = Vector2d::Zero();
  for (int i = 0; i < 4; ++i) {
    const double* row = &controls_[static_cast<std::size_t>(patch.i + i) * ny_ + patch.j];
    for (int j = 0; j < 4; ++j) sum += row[j] * Vector2d(dx[i] * wy[j], wx[i] * dy[j]);
  }
  return sum / kSpacing;
}

Terrain Terrain::along(std::span<const Vector3d> path, const Vector2d& low, const Vector2d& high) {
  Terrain terrain(low, high);
  Equations equations(terrain.nx_ * terrain.ny_);
  const auto add_height = [&](const Vector3d& place, double factor) {
    const Patch patch = terrain.patch_at(place.head<2>());
    const Weights wx = value_weights(patch.u), wy = value_weights(patch.v);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        equations.add((patch.i + i) * terrain.ny_ + patch.j + j, factor * wx[i] * wy[j]);
  };
  add_height(path.front(), 1.0 / kClimbError);
  equations.close_row(path.front().z() / kClimbError);
  for (std::size_t i = 1; i < path.size(); ++i) {
    add_height(path[i], 1.0 / kClimbError);
    add_height(path[i - 1], -1.0 / kClimbError);
    equations.close_row((path[i].z() - path[i - 1].z()) / kClimbError);
  }
  const auto add_bend = [&](int a, int b, int c, int d, double factor) {
    equations.add(a, factor);
    equations.add(b, -factor);
    equations.add(c, -factor);
    equations.add(d, factor);
    equations.close_row(0.0);
  };
  const double stiffness = 1.0 / kBendError;
  for (int i = 0; i < terrain.nx_; ++i) {
    for (int j = 0; j < terrain.ny_; ++j) {
      const auto at = [&](int di, int dj) { return (i + di) * terrain.ny_ + j + dj; };
      const bool right = i + 2 < terrain.nx_, up = j + 2 < terrain.ny_;
      if (right) add_bend(at(0, 0), at(1, 0), at(1, 0), at(2, 0), stiffness);
      if (up) add_bend(at(0, 0), at(0, 1), at(0, 1), at(0, 2), stiffness);
      if (right && up) add_bend(at(0, 0), at(1, 0), at(0, 1), at(1, 1), std::sqrt(2.0) * stiffness);
    }
  }
  terrain.controls_ = equations.solve();
  return terrain;
}

Pose stand_on(const Terrain& terrain, const Vector2d& place, double yaw) {
  const Vector2d slope = terrain.slope(place);
  const Vector2d heading(std::cos(yaw), std::sin(yaw));
  const Vector3d up = Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  const Vector3d forward = Vector3d(heading.x(), heading.y(), slope.dot(heading)).normalized();
  Pose pose = Pose::Identity();
  pose.linear() << forward, up.cross(forward), up;
  pose.translation() = Vector3d(place.x(), place.y(), terrain.height(place));
  return pose;
}

}  // namespace lego_loam_sc
