// SPDX-License-Identifier: BSD-3-Clause
#include "graph/edge_covariance.hpp"

namespace lego_loam_sc {
namespace {

// From the axes of the matcher's target to those of the matched frame.
Matrix6 turned(const Matrix6& covariance, const Eigen::Matrix3d& R) {
  Matrix6 B = Matrix6::Zero();
  B.topLeftCorner<3, 3>() = R.transpose();
  B.bottomRightCorner<3, 3>() = R.transpose();
  return B * covariance * B.transpose();
}

void add_floor(double sigma, double sigma_deg, Matrix6& covariance) {
  covariance.diagonal().head<3>().array() += sigma * sigma;
  covariance.diagonal().tail<3>().array() += radians(sigma_deg) * radians(sigma_deg);
}

}  // namespace

Matrix6 loop_covariance(const Matrix6& covariance, const Eigen::Matrix3d& R,
                        const GraphSettings& settings) {
  Matrix6 result = turned(covariance, R);
  add_floor(settings.loop_sigma, settings.loop_sigma_deg, result);
  return result;
}

Matrix6 odometry_covariance(const Matrix6& covariance, const Eigen::Matrix3d& R,
                            const Localizability& localizability, const GraphSettings& settings) {
  const double t = settings.degenerate_inflation * settings.odometry_sigma;
  const double r = settings.degenerate_inflation * radians(settings.odometry_sigma_deg);
  const Matrix6 inflation = degenerate_projection(localizability, t * t, r * r);
  Matrix6 result = turned(covariance + inflation, R);
  add_floor(settings.odometry_sigma, settings.odometry_sigma_deg, result);
  return result;
}

}  // namespace lego_loam_sc
