// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mapper.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mapping/voxel_filter.hpp"
#include "odometry/correspondence.hpp"
#include "odometry/deskew.hpp"

namespace lego_loam_sc {
namespace {

// The kernel's scale in robust sigmas of the residuals, and its limits in m.
constexpr double kKernelSigmas = 2.0;
constexpr double kMinScale = 0.02;
constexpr double kMaxScale = 0.5;
// A degenerate direction is tied to the guess with this sigma, m or rad.
constexpr double kTied = 1e-4;
// Constraints below which a direction is not weakly held but not at all.
constexpr double kNothing = 1.0;
// Times that the spacing of the points is halved in small spaces.
constexpr int kHalvings = 2;
// The map is searched for voxels out of reach after this share of its radius has been driven.
constexpr double kEvictionShare = 0.1;

// The prior: deviations from the guess cost (delta / sigma)^2 / 2.
class Prior {
 public:
  Prior(const Pose& guess, double sigma_translation, double sigma_rotation) : guess_(guess) {
    const double t = 1.0 / (sigma_translation * sigma_translation);
    const double r = 1.0 / (sigma_rotation * sigma_rotation);
    information_.diagonal() << t, t, t, r, r, r;
  }

  void tie(const Localizability& l) {
    constexpr double kInformation = 1.0 / (kTied * kTied);
    for (int i = 0; i < l.degenerate_translations; ++i)
      information_.topLeftCorner<3, 3>() +=
          kInformation * l.translation_axes.col(i) * l.translation_axes.col(i).transpose();
    for (int i = 0; i < l.degenerate_rotations; ++i)
      information_.bottomRightCorner<3, 3>() +=
          kInformation * l.rotation_axes.col(i) * l.rotation_axes.col(i).transpose();
  }

  void add_to(NormalEquations<6>& equations, const Pose& at) const {
    Vector6 deviation;
    deviation << at.translation() - guess_.translation(),
        log_so3(at.linear() * guess_.linear().transpose());
    equations.H += information_;
    equations.g += information_ * deviation;
    equations.cost += 0.5 * deviation.dot(information_ * deviation);
  }

 private:
  Pose guess_;
  Matrix6 information_ = Matrix6::Zero();
};

// Where the map shows nothing at all the odometry has matched noise with noise, which stands still: there
// the last motion goes on instead.
Pose predicted_where_nothing_holds(const ScanGuess& guess, const Localizability& l) {
  Vector6 delta;
  delta << guess.T_map_predicted.translation() - guess.T_map_lidar.translation(),
      log_so3(guess.T_map_predicted.linear() * guess.T_map_lidar.linear().transpose());
  Vector6 change = Vector6::Zero();
  for (int i = 0; i < 3; ++i) {
    if (l.translation[i] < kNothing)
      change.head<3>() +=
          l.translation_axes.col(i) * l.translation_axes.col(i).dot(delta.head<3>());
    if (l.rotation[i] < kNothing)
      change.tail<3>() += l.rotation_axes.col(i) * l.rotation_axes.col(i).dot(delta.tail<3>());
  }
  return perturb(guess.T_map_lidar, change);
}

std::vector<FeaturePoint> thin_out(const std::vector<FeaturePoint>& points, double spacing) {
  return voxel_filter(points, spacing, [](const FeaturePoint& p) { return p.position; });
}

double weighted_rmse(const std::vector<Correspondence>& correspondences, const Pose& pose,
                     double scale) {
  double sum = 0.0;
  double weights = 0.0;
  for (const Correspondence& c : correspondences) {
    const double d = distance(c, pose);
    const double weight = robust_weight(d, scale);
    sum += weight * d * d;
    weights += weight;
  }
  return weights > 0.0 ? std::sqrt(sum / weights) : 0.0;
}

}  // namespace

Mapper::Mapper(const MappingSettings& settings, double range_noise)
    : settings_(settings),
      range_noise_(std::max(range_noise, 1e-3)),
      map_(settings.voxel_size, settings.levels, settings.planarity) {}

MapMatch Mapper::refine(const Features& features, const ScanGuess& guess) {
  MapMatch match;
  match.T_map_lidar = guess.T_map_lidar;
  const double prior_rotation = radians(settings_.prior_rotation_deg);
  match.covariance.diagonal() << Eigen::Vector3d::Constant(std::pow(settings_.prior_translation, 2)),
      Eigen::Vector3d::Constant(prior_rotation * prior_rotation);
  std::vector<FeaturePoint> planars, edges;
  double spacing = settings_.match_spacing;
  for (int k = 0; k == 0 || (k <= kHalvings && match.points < settings_.match_points);
       ++k, spacing *= 0.5) {
    planars = thin_out(features.planars_large, spacing);
    edges = thin_out(features.edges_large, spacing);
    match.points = static_cast<int>(planars.size() + edges.size());
  }

  Pose pose = guess.T_map_lidar;
  const Pose T_previous_map = guess.T_previous_current * guess.T_map_lidar.inverse();
  Prior prior(pose, settings_.prior_translation, prior_rotation);
  std::vector<Correspondence> correspondences;
  double scale = kMaxScale;
  Matrix6 H = Matrix6::Identity();
  for (int k = 0; k < settings_.associations; ++k) {
    const Vector6 twist = log_se3(T_previous_map * pose) / guess.seconds;
    correspondences.clear();
    map_.match_planars(deskew(planars, twist), pose, settings_.max_distance, range_noise_, 0,
                       correspondences);
    map_.match_edges(deskew(edges, twist), pose, settings_.max_distance, range_noise_, 0,
                     correspondences);
    match.matches = static_cast<int>(correspondences.size());
    if (match.matches < settings_.min_matches ||
        match.matches < settings_.min_matched_share * match.points)
      return match;

    scale = robust_scale(correspondences, pose, kKernelSigmas, kMinScale, kMaxScale);
    if (k == 0) {
      match.localizability = localizability(correspondences, pose, scale, settings_.min_strength);
      pose = predicted_where_nothing_holds(guess, match.localizability);
      prior = Prior(pose, settings_.prior_translation, prior_rotation);
      prior.tie(match.localizability);
    }
    const auto result = levenberg_marquardt<6>(
        pose, settings_.iterations,
        [&](const Pose& at) {
          NormalEquations<6> equations = normal_equations(correspondences, at, scale);
          prior.add_to(equations, at);
          H = equations.H;
          return equations;
        },
        perturb);
    match.iterations += result.iterations;
    if (result.step < kConvergedStep) break;
  }
  if (settings_.elevation_bias) {
    NormalEquations<6> solution = normal_equations(correspondences, pose, scale);
    prior.add_to(solution, pose);
    elevation_bias_.add(correspondences, pose, scale, solution);
  }
  match.matched = true;
  match.T_map_lidar = normalized(pose);
  match.rmse = weighted_rmse(correspondences, pose, scale);
  match.covariance = H.inverse();
  return match;
}

void Mapper::insert(const Features& deskewed, const Pose& T_map_lidar) {
  map_.insert_planars(deskewed.planars_large, T_map_lidar);
  map_.insert_edges(deskewed.edges_large, T_map_lidar);
  const Eigen::Vector3d position = T_map_lidar.translation();
  if ((position - last_eviction_).norm() > kEvictionShare * settings_.radius) {
    map_.remove_beyond(position, settings_.radius);
    last_eviction_ = position;
  }
}

}  // namespace lego_loam_sc
