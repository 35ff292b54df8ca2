// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mapper.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "map/thin_out.hpp"
#include "mapping/sweep_priors.hpp"
#include "registration/correspondence.hpp"
#include "registration/deskew.hpp"

namespace lego_loam_sc {
namespace {

// The kernel's scale in robust spreads of the residuals, and its limits in their sigmas.
constexpr double kKernelSpreads = 2.0;
constexpr double kMinScale = 1.0;
constexpr double kMaxScale = 20.0;
// The spacing of the matched points, as a share of the setting, in the smallest spaces.
constexpr double kLeastSpacing = 0.125;
// Associations end with the one that moves the pose by less, m and rad.
constexpr double kSettled = 5e-4;
// The map is searched for voxels out of reach after this share of its radius has been driven.
constexpr double kEvictionShare = 0.2;

using Vector12 = Eigen::Matrix<double, 12, 1>;

// A velocity as unknown is what it moves in this time, s: half a sweep or so. Then a step of it is
// as large as what it does to the points.
constexpr double kVelocityUnit = 0.05;

Sweep changed(const Sweep& sweep, const Vector12& delta) {
  return {perturb(sweep.T_map_lidar, delta.head<6>()),
          sweep.velocity_change + delta.tail<6>() / kVelocityUnit};
}

void change_unit(NormalEquations<12>& equations) {
  equations.H.rightCols<6>() /= kVelocityUnit;
  equations.H.bottomRows<6>() /= kVelocityUnit;
  equations.g.tail<6>() /= kVelocityUnit;
}

Vector6 in_axes_of_lidar(const Sweep& sweep) {
  const Eigen::Matrix3d to_lidar = sweep.T_map_lidar.linear().transpose();
  Vector6 change;
  change << to_lidar * sweep.velocity_change.head<3>(), to_lidar * sweep.velocity_change.tail<3>();
  return change;
}

// What de-skewing with a twist that differs by `change` would have done to the points, to first
// order.
void move_on(std::vector<Correspondence>& correspondences, const Vector6& change) {
  for (Correspondence& c : correspondences)
    c.point += c.age * (change.head<3>() + change.tail<3>().cross(c.point));
}

// In directions that the map does not hold the odometry has matched noise with noise, which stands
// still: there the last motion goes on instead.
Pose predicted_where_degenerate(const ScanGuess& guess, const Localizability& l) {
  Vector6 delta;
  delta << guess.T_map_predicted.translation() - guess.T_map_lidar.translation(),
      log_so3(guess.T_map_predicted.linear() * guess.T_map_lidar.linear().transpose());
  Vector6 change = Vector6::Zero();
  for (int i = 0; i < l.degenerate_translations; ++i)
    change.head<3>() += l.translation_axes.col(i) * l.translation_axes.col(i).dot(delta.head<3>());
  for (int i = 0; i < l.degenerate_rotations; ++i)
    change.tail<3>() += l.rotation_axes.col(i) * l.rotation_axes.col(i).dot(delta.tail<3>());
  return perturb(guess.T_map_lidar, change);
}

// The share is that of all points, or without the scattered ones: the map has few of those where
// the scans that made it had edges enough.
bool enough(const std::vector<Correspondence>& correspondences, const Features& points,
            const MappingSettings& settings) {
  const auto shaped = points.planars_large.size() + points.edges_large.size();
  const auto matched = correspondences.size();
  const auto matched_shaped =
      std::count_if(correspondences.begin(), correspondences.end(),
                    [](const Correspondence& c) { return c.kind != Correspondence::Kind::point; });
  const auto all = static_cast<double>(shaped + points.scattered.size());
  return matched >= static_cast<std::size_t>(settings.min_matches) &&
         (static_cast<double>(matched) >= settings.min_matched_share * all ||
          static_cast<double>(matched_shaped) >=
              settings.min_matched_share * static_cast<double>(shaped));
}

int count_agreeing(const std::vector<Correspondence>& correspondences, const Pose& pose) {
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

}  // namespace

Mapper::Mapper(const MappingSettings& settings, double range_noise, double row_spacing)
    : settings_(settings),
      range_noise_(std::max(range_noise, 1e-3)),
      map_(settings.voxel_size, settings.levels, settings.planarity, row_spacing),
      spacing_(settings.match_points == 0 ? settings.match_spacing
                                          : kLeastSpacing * settings.match_spacing) {}

// The points that a scan leaves lie on surfaces: a quarter of them at twice the spacing. The scan
// shows what the next one will leave.
void Mapper::adapt_spacing(int points) {
  if (settings_.match_points == 0) return;
  const double share = static_cast<double>(points) / settings_.match_points;
  spacing_ = std::clamp(spacing_ * std::clamp(std::sqrt(share), 0.5, 2.0),
                        kLeastSpacing * settings_.match_spacing, settings_.match_spacing);
}

MapMatch Mapper::refine(const Features& features, const ScanGuess& guess) {
  MapMatch match;
  match.T_map_lidar = guess.T_map_lidar;
  const double prior_rotation = radians(settings_.prior_rotation_deg);
  match.covariance.diagonal() << Eigen::Vector3d::Constant(
      std::pow(settings_.prior_translation, 2)),
      Eigen::Vector3d::Constant(prior_rotation * prior_rotation);
  const Features points = thin_out(features, spacing_);
  match.points = static_cast<int>(points.planars_large.size() + points.edges_large.size() +
                                  points.scattered.size());
  adapt_spacing(match.points);

  Pose pose = guess.T_map_lidar;
  // A prediction is off by what the sensor may have accelerated.
  const double acceleration = settings_.acceleration * guess.seconds * guess.seconds;
  const double prior_translation = guess.measured || acceleration == 0.0
                                       ? settings_.prior_translation
                                       : std::min(acceleration, settings_.prior_translation);
  PosePrior prior(pose, prior_translation, prior_rotation);
  const VelocityPrior velocity_prior(guess.T_previous_current * guess.T_map_lidar.inverse(),
                                     guess.seconds, settings_.acceleration,
                                     radians(settings_.angular_acceleration_deg));
  Vector6 twist = velocity_prior.mean(pose);
  std::vector<Correspondence> correspondences;
  MatchedSurfaces surfaces;
  double scale = kMaxScale;
  for (int k = 0; k < settings_.associations; ++k) {
    correspondences =
        map_.match(deskew(points, twist), pose, settings_.max_distance, range_noise_, 0, surfaces);
    match.matches = static_cast<int>(correspondences.size());
    if (!enough(correspondences, points, settings_)) return match;

    scale = robust_scale(correspondences, pose, kKernelSpreads, kMinScale, kMaxScale);
    if (k == 0) {
      match.localizability = localizability(correspondences, pose, scale, settings_.min_strength);
      pose = predicted_where_degenerate(guess, match.localizability);
      prior = PosePrior(pose, prior_translation, prior_rotation);
      prior.tie(match.localizability);
    }
    Sweep sweep{pose};
    const auto result = levenberg_marquardt<12>(
        sweep, settings_.iterations,
        [&](const Sweep& at) {
          NormalEquations<12> equations =
              sweep_normal_equations(correspondences, at.T_map_lidar, at.velocity_change, scale);
          prior.add_to(equations, at.T_map_lidar);
          velocity_prior.add_to(equations, at, twist);
          change_unit(equations);
          return equations;
        },
        changed);
    pose = sweep.T_map_lidar;
    const Vector6 change = in_axes_of_lidar(sweep);
    twist += change;
    move_on(correspondences, change);
    match.iterations += result.iterations;
    if (result.step < kSettled) break;
  }
  NormalEquations<12> solution =
      sweep_normal_equations(correspondences, pose, Vector6::Zero(), scale);
  prior.add_to(solution, pose);
  velocity_prior.add_to(solution, Sweep{pose}, twist);
  // Where the pose is a guess the residuals are as well.
  if (!match.localizability.degenerate())
    sweep_check_.add(correspondences, pose, scale, velocity_prior.mean(pose), twist);
  if (settings_.elevation_bias && !match.localizability.degenerate()) {
    elevation_bias_.add(correspondences, pose, scale, solution);
    row_bias_.add(correspondences, pose, scale);
  }
  match.matched = true;
  match.T_map_lidar = normalized(pose);
  match.twist = twist;
  match.agreeing = count_agreeing(correspondences, pose);
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
