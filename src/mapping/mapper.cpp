// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mapper.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "map/voxel_filter.hpp"
#include "mapping/sweep_priors.hpp"
#include "registration/correspondence.hpp"
#include "registration/deskew.hpp"

namespace lego_loam_sc {
namespace {

constexpr RobustKernel kKernel{.factor = 2.0, .min_scale = 1.0, .max_scale = 20.0};
// Lower limit of the spacing of the matched points, as a share of the setting.
constexpr double kMinSpacing = 0.125;
// Association and solve are repeated until the pose moves by less: 0.5 mm or 0.5 mrad.
constexpr double kPoseConvergence = 5e-4;
// Voxels beyond the radius are removed after each movement by this share of it.
constexpr double kEvictionShare = 0.2;

using Vector12 = Eigen::Matrix<double, 12, 1>;

// s, about half a sweep. The solver's velocity unknowns are the displacement in this time, so that
// one convergence threshold suits pose and velocity.
constexpr double kVelocityUnit = 0.05;

Sweep retract(const Sweep& sweep, const Vector12& delta) {
  return {perturb(sweep.T_map_lidar, delta.head<6>()),
          sweep.velocity_change + delta.tail<6>() / kVelocityUnit};
}

void scale_velocity_unknowns(NormalEquations<12>& equations) {
  equations.H.rightCols<6>() /= kVelocityUnit;
  equations.H.bottomRows<6>() /= kVelocityUnit;
  equations.g.tail<6>() /= kVelocityUnit;
}

Vector6 velocity_change_in_lidar_axes(const Sweep& sweep) {
  const Eigen::Matrix3d to_lidar = sweep.T_map_lidar.linear().transpose();
  Vector6 change;
  change << to_lidar * sweep.velocity_change.head<3>(), to_lidar * sweep.velocity_change.tail<3>();
  return change;
}

// Moves de-skewed points as if the twist had been greater by `change`, to first order.
void apply_velocity_change(std::vector<Correspondence>& correspondences, const Vector6& change) {
  for (Correspondence& c : correspondences)
    c.point += c.time * (change.head<3>() + change.tail<3>().cross(c.point));
}

// In degenerate directions the odometry matches noise with noise and underestimates the motion, so
// the constant-velocity prediction replaces it there.
Pose predict_where_degenerate(const ScanGuess& guess, const Localizability& l) {
  const Vector6 delta = perturbation_between(guess.T_map_lidar, guess.T_map_predicted);
  return perturb(guess.T_map_lidar, degenerate_component(l, delta));
}

// The matched share must be reached by all points or by planar and edge points alone: the map has
// few scattered points where its scans had enough edges.
bool has_enough_matches(const std::vector<Correspondence>& correspondences, const Features& points,
                        const MappingSettings& settings) {
  const auto surface_points = points.planars_large.size() + points.edges_large.size();
  const auto matched = correspondences.size();
  const auto matched_surface_points =
      std::count_if(correspondences.begin(), correspondences.end(),
                    [](const Correspondence& c) { return c.kind != Correspondence::Kind::point; });
  const auto all = static_cast<double>(surface_points + points.scattered.size());
  return matched >= static_cast<std::size_t>(settings.min_matches) &&
         (static_cast<double>(matched) >= settings.min_matched_share * all ||
          static_cast<double>(matched_surface_points) >=
              settings.min_matched_share * static_cast<double>(surface_points));
}

int count_inliers(const std::vector<Correspondence>& correspondences, const Pose& pose) {
  return static_cast<int>(std::count_if(
      correspondences.begin(), correspondences.end(),
      [&](const Correspondence& c) { return distance(c, pose) * std::sqrt(c.weight) < 3.0; }));
}

double weighted_rmse(const std::vector<Correspondence>& correspondences, const Pose& pose,
                     double scale) {
  double sum = 0.0;
  double weights = 0.0;
  for (const Correspondence& c : correspondences) {
    const double d = distance(c, pose);
    const double weight = robust_weight(c, d, scale) / c.weight;
    sum += weight * d * d;
    weights += weight;
  }
  return weights > 0.0 ? std::sqrt(sum / weights) : 0.0;
}

// The result of a scan that is not matched: the guess with the prior's covariance.
MapMatch unmatched(const Features& points, const ScanGuess& guess,
                   const MappingSettings& settings) {
  MapMatch match;
  match.T_map_lidar = guess.T_map_lidar;
  const double rotation = radians(settings.prior_rotation_deg);
  match.covariance.diagonal() << Eigen::Vector3d::Constant(std::pow(settings.prior_translation, 2)),
      Eigen::Vector3d::Constant(rotation * rotation);
  match.points = static_cast<int>(points.planars_large.size() + points.edges_large.size() +
                                  points.scattered.size());
  return match;
}

// A predicted pose is off by what the sensor may have accelerated since the previous scan.
PosePrior pose_prior(const Pose& mean, const ScanGuess& guess, const MappingSettings& settings) {
  const double acceleration = settings.acceleration * guess.seconds * guess.seconds;
  const double translation = guess.measured || acceleration == 0.0
                                 ? settings.prior_translation
                                 : std::min(acceleration, settings.prior_translation);
  return PosePrior(mean, translation, radians(settings.prior_rotation_deg));
}

// Minimises over the pose and the velocity of a sweep that was de-skewed with `twist`.
LevenbergMarquardtResult solve(std::span<const Correspondence> correspondences,
                               const PosePrior& prior, const VelocityPrior& velocity_prior,
                               const Vector6& twist, double scale, int iterations, Sweep& sweep) {
  return levenberg_marquardt<12>(
      sweep, iterations,
      [&](const Sweep& at) {
        NormalEquations<12> equations =
            sweep_normal_equations(correspondences, at.T_map_lidar, at.velocity_change, scale);
        prior.add_to(equations, at.T_map_lidar);
        velocity_prior.add_to(equations, at, twist);
        scale_velocity_unknowns(equations);
        return equations;
      },
      retract);
}

}  // namespace

Mapper::Mapper(const MappingSettings& settings, double range_noise, double row_spacing)
    : settings_(settings),
      range_noise_(std::max(range_noise, 1e-3)),
      map_(settings.voxel_size, settings.levels, settings.planarity, row_spacing),
      spacing_(settings.match_points == 0 ? settings.match_spacing
                                          : kMinSpacing * settings.match_spacing) {}

// The number of filtered points falls with the square of the spacing, since they lie on surfaces.
// The next scan leaves about as many as this one.
void Mapper::adapt_spacing(int points) {
  if (settings_.match_points == 0) return;
  const double share = static_cast<double>(points) / settings_.match_points;
  spacing_ = std::clamp(spacing_ * std::clamp(std::sqrt(share), 0.5, 2.0),
                        kMinSpacing * settings_.match_spacing, settings_.match_spacing);
}

MapMatch Mapper::refine(const Features& features, const ScanGuess& guess) {
  const Features points = voxel_filter(features, spacing_);
  MapMatch match = unmatched(points, guess, settings_);
  adapt_spacing(match.points);

  Pose pose = guess.T_map_lidar;
  PosePrior prior = pose_prior(pose, guess, settings_);
  const VelocityPrior velocity_prior(guess.T_previous_current * guess.T_map_lidar.inverse(),
                                     guess.seconds, settings_.acceleration,
                                     radians(settings_.angular_acceleration_deg));
  Vector6 twist = velocity_prior.mean(pose);
  std::vector<Correspondence> correspondences;
  MatchedSurfaces surfaces;
  double scale = kKernel.max_scale;
  for (int k = 0; k < settings_.associations; ++k) {
    correspondences =
        map_.match(deskew(points, twist), pose, settings_.max_distance, range_noise_, 0, surfaces);
    match.matches = static_cast<int>(correspondences.size());
    if (!has_enough_matches(correspondences, points, settings_)) return match;

    scale = robust_scale(correspondences, pose, kKernel);
    if (k == 0) {
      match.localizability = localizability(correspondences, pose, scale, settings_.min_strength);
      pose = predict_where_degenerate(guess, match.localizability);
      prior = pose_prior(pose, guess, settings_);
      prior.fix_degenerate(match.localizability);
    }
    Sweep sweep{pose};
    const LevenbergMarquardtResult result =
        solve(correspondences, prior, velocity_prior, twist, scale, settings_.iterations, sweep);
    pose = sweep.T_map_lidar;
    const Vector6 change = velocity_change_in_lidar_axes(sweep);
    twist += change;
    apply_velocity_change(correspondences, change);
    match.iterations += result.iterations;
    if (result.step < kPoseConvergence) break;
  }
  NormalEquations<12> solution =
      sweep_normal_equations(correspondences, pose, Vector6::Zero(), scale);
  prior.add_to(solution, pose);
  velocity_prior.add_to(solution, Sweep{pose}, twist);
  match.matched = true;
  match.T_map_lidar = normalized(pose);
  match.twist = twist;
  match.inliers = count_inliers(correspondences, pose);
  match.rmse = weighted_rmse(correspondences, pose, scale);
  match.covariance = solution.H.inverse().topLeftCorner<6, 6>();
  return match;
}

void Mapper::clear() {
  map_.clear();
  last_insertion_.reset();
}

void Mapper::insert(const Features& deskewed, const Pose& T_map_lidar) {
  map_.insert(deskewed, T_map_lidar);
}

void Mapper::add_scan(const Features& deskewed, const Pose& T_map_lidar) {
  const Eigen::Vector3d position = T_map_lidar.translation();
  if (last_insertion_ && (position - *last_insertion_).norm() < settings_.insert_distance) return;
  last_insertion_ = position;
  insert(deskewed, T_map_lidar);
  if ((position - last_eviction_).norm() > kEvictionShare * settings_.radius) {
    map_.remove_beyond(position, settings_.radius);
    last_eviction_ = position;
  }
}

}  // namespace lego_loam_sc
