// SPDX-License-Identifier: BSD-3-Clause
#include "registration/correspondence.hpp"

#include <algorithm>
#include <cmath>

namespace lego_loam_sc {
namespace {

// Upper limit of the squared distance over the squared scale: the product of two costs stays
// finite.
constexpr double kMaxSquaredDistance = 1e100;

using Matrix36 = Eigen::Matrix<double, 3, 6>;

// Offset from the plane along its normal, from the line across it, or from the point.
Eigen::Vector3d residual(const Correspondence& c, const Eigen::Vector3d& transformed) {
  const Eigen::Vector3d offset = transformed - c.anchor;
  const Eigen::Vector3d along = c.direction * c.direction.dot(offset);
  return c.kind == Correspondence::Kind::plane ? along : Eigen::Vector3d(offset - along);
}

// Sigma of normally distributed residuals from the median of their absolute values; reorders them.
double sigma_from_median(std::vector<double>& absolute) {
  const auto middle = absolute.begin() + absolute.size() / 2;
  std::nth_element(absolute.begin(), middle, absolute.end());
  return 1.4826 * *middle;
}

// Sums log(x) of numbers x >= 1. Logarithms are slow, so products of many numbers are taken first.
class LogSum {
 public:
  void add(double x) {
    product_ *= x;
    if (product_ < 1e200) return;
    sum_ += std::log(product_);
    product_ = 1.0;
  }
  double value() const { return sum_ + std::log(product_); }

 private:
  double product_ = 1.0;
  double sum_ = 0.0;
};

// Passes J'J and J'r of one weighted distance to `add` and returns 1 + (sigmas / scale)^2, whose
// logarithm is the cost. `rotated` is the point relative to the origin of the source in axes of the
// target, `moved` the point in the target frame.
template <class Add>
double linearise(const Correspondence& c, const Eigen::Vector3d& rotated,
                 const Eigen::Vector3d& moved, double scale, Add&& add) {
  double squared = 0.0;
  if (c.kind == Correspondence::Kind::plane) {
    const double d = c.direction.dot(moved - c.anchor);
    squared = d * d;
    Vector6 row;
    row << c.direction, rotated.cross(c.direction);
    const Vector6 weighted = robust_weight(c, d, scale) * row;
    add(Matrix6(weighted * row.transpose()), d * weighted);
  } else {
    const Eigen::Vector3d e = residual(c, moved);
    squared = e.squaredNorm();
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - c.direction * c.direction.transpose();
    Matrix36 rows;
    rows.leftCols<3>() = across;
    rows.rightCols<3>() = -across * skew(rotated);
    const double weight = robust_weight(c, std::sqrt(squared), scale);
    add(Matrix6((weight * rows.transpose()).lazyProduct(rows)), weight * rows.transpose() * e);
  }
  return 1.0 + std::min(c.weight * squared / (scale * scale), kMaxSquaredDistance);
}

}  // namespace

double distance(const Correspondence& c, const Pose& T_target_source) {
  return residual(c, T_target_source * c.point).norm();
}

double robust_weight(const Correspondence& c, double distance, double scale) {
  return c.weight / (1.0 + c.weight * distance * distance / (scale * scale));
}

double robust_scale(std::span<const Correspondence> correspondences, const Pose& T_target_source,
                    const RobustKernel& kernel) {
  if (correspondences.empty()) return kernel.max_scale;
  std::vector<double> sigmas;
  sigmas.reserve(correspondences.size());
  for (const Correspondence& c : correspondences)
    sigmas.push_back(distance(c, T_target_source) * std::sqrt(c.weight));
  return std::clamp(kernel.factor * sigma_from_median(sigmas), kernel.min_scale, kernel.max_scale);
}

double robust_sigma(std::span<const Correspondence> correspondences, const Pose& T_target_source) {
  if (correspondences.empty()) return 0.0;
  std::vector<double> distances;
  distances.reserve(correspondences.size());
  for (const Correspondence& c : correspondences) distances.push_back(distance(c, T_target_source));
  return sigma_from_median(distances);
}

NormalEquations<6> normal_equations(std::span<const Correspondence> correspondences,
                                    const Pose& T_target_source, double scale) {
  NormalEquations<6> sum;
  LogSum cost;
  for (const Correspondence& c : correspondences) {
    const Eigen::Vector3d rotated = T_target_source.linear() * c.point;
    cost.add(linearise(c, rotated, rotated + T_target_source.translation(), scale,
                       [&](const auto& JtJ, const Vector6& Jtr) {
                         sum.H += JtJ;
                         sum.g += Jtr;
                       }));
  }
  sum.cost = 0.5 * scale * scale * cost.value();
  return sum;
}

NormalEquations<12> sweep_normal_equations(std::span<const Correspondence> correspondences,
                                           const Pose& T_target_source,
                                           const Vector6& velocity_change, double scale) {
  NormalEquations<12> sum;
  LogSum cost;
  std::array<Matrix6, 3> H;  // by powers of the time
  H.fill(Matrix6::Zero());
  for (const Correspondence& c : correspondences) {
    const Eigen::Vector3d rotated = T_target_source.linear() * c.point;
    const Eigen::Vector3d moved =
        rotated + T_target_source.translation() +
        c.time * (velocity_change.head<3>() + velocity_change.tail<3>().cross(rotated));
    cost.add(linearise(c, rotated, moved, scale, [&](const auto& JtJ, const Vector6& Jtr) {
      H[0] += JtJ;
      H[1] += c.time * JtJ;
      H[2] += c.time * c.time * JtJ;
      sum.g.head<6>() += Jtr;
      sum.g.tail<6>() += c.time * Jtr;
    }));
  }
  sum.H << H[0], H[1], H[1], H[2];
  sum.cost = 0.5 * scale * scale * cost.value();
  return sum;
}

}  // namespace lego_loam_sc
