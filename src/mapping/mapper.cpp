// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mapper.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "map/voxel_filter.hpp"
#include "mapping/observability.hpp"
#include "mapping/pose_search.hpp"
#include "registration/correspondence.hpp"
#include "registration/deskew.hpp"

namespace lego_loam_sc {
namespace {

// Narrow: the guess is the odometry's.
constexpr RobustKernel kKernel{.factor = 2.0, .min_scale = 1.0, .max_scale = 20.0};
// Lower limit of the spacing of the matched points, as a share of the setting.
constexpr double kMinSpacing = 0.125;
// Association and solve are repeated until the pose moves by less: 0.5 mm or 0.5 mrad.
constexpr double kPoseConvergence = 5e-4;
// Where the sensor may be after an unknown motion: m/s, and deg from one scan to the next.
constexpr double kMaxSpeed = 40.0;
// m; farther away, after a gap, the grid would take seconds.
constexpr double kMaxSearch = 8.0;
constexpr double kMaxTurnDeg = 20.0;
// A pose far from the guess must agree so much better: the scores of two good matches differ by
// chance.
constexpr double kClearlyBetter = 1.05;
// Poses of the search that are refined.
constexpr int kSearchStarts = 5;
// A direction with a smaller share of the constraints may be degenerate.
constexpr double kWeakShare = 0.025;
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

// In degenerate directions a registration follows noise, which does not move, so the
// constant-velocity prediction replaces it there.
Pose predict_where_degenerate(const Pose& pose, const Pose& predicted, const Localizability& l) {
  return perturb(pose, degenerate_component(l, perturbation_between(pose, predicted)));
}

std::vector<Correspondence> without_points(const std::vector<Correspondence>& correspondences) {
  std::vector<Correspondence> result;
  std::copy_if(correspondences.begin(), correspondences.end(), std::back_inserter(result),
               [](const Correspondence& c) { return c.kind != Correspondence::Kind::point; });
  return result;
}

// m, of the matched points from the sensor.
double mean_range(const std::vector<Correspondence>& correspondences) {
  double sum = 0.0;
  for (const Correspondence& c : correspondences) sum += c.point.norm();
  return sum / static_cast<double>(correspondences.size());
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

using Scales = std::array<double, 3>;

// Of the kernel of each set: the ground must not decide which edges are outliers.
Scales robust_scales(const MapCorrespondences& correspondences, const Pose& pose) {
  Scales scales;
  for (std::size_t i = 0; i < scales.size(); ++i)
    scales[i] = robust_scale(correspondences.set(i), pose, kKernel);
  return scales;
}

NormalEquations<12> sweep_equations(const MapCorrespondences& correspondences, const Sweep& at,
                                    const Scales& scales) {
  NormalEquations<12> sum;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const NormalEquations<12> of_set = sweep_normal_equations(
        correspondences.set(i), at.T_map_lidar, at.velocity_change, scales[i]);
    sum.H += of_set.H;
    sum.g += of_set.g;
    sum.cost += of_set.cost;
  }
  return sum;
}

int count_inliers(const MapCorrespondences& correspondences, const Pose& pose) {
  return static_cast<int>(std::count_if(
      correspondences.all.begin(), correspondences.all.end(),
      [&](const Correspondence& c) { return distance(c, pose) * std::sqrt(c.weight) < 3.0; }));
}

double weighted_rmse(const MapCorrespondences& correspondences, const Pose& pose,
                     const Scales& scales) {
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    for (const Correspondence& c : correspondences.set(i)) {
      if (c.kind == Correspondence::Kind::point) continue;
      const double d = distance(c, pose);
      const double weight = robust_weight(c, d, scales[i]) / c.weight;
      sum += weight * d * d;
      weights += weight;
    }
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
LevenbergMarquardtResult solve(const MapCorrespondences& correspondences, const Scales& scales,
                               const PosePrior& prior, const VelocityPrior& velocity_prior,
                               const Vector6& twist, int iterations, Sweep& sweep) {
  return levenberg_marquardt<12>(
      sweep, iterations,
      [&](const Sweep& at) {
        NormalEquations<12> equations = sweep_equations(correspondences, at, scales);
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

Features Mapper::points_to_match(const Features& features) {
  Features points = voxel_filter(features, spacing_);
  adapt_spacing(static_cast<int>(points.planars_large.size() + points.edges_large.size()));
  points.scattered = subsample(points.scattered, settings_.scattered_points);
  return points;
}

MapMatch Mapper::refine(const Features& features, const ScanGuess& guess) {
  return align(points_to_match(features), guess);
}

MapMatch Mapper::search(const Features& features, const ScanGuess& guess,
                        const Pose& T_map_previous) {
  const Features points = points_to_match(features);
  MapMatch best = align(points, guess);
  const auto score = [&](const MapMatch& match) {
    return agreement(map_, deskew(points, match.twist), match.T_map_lidar, settings_.voxel_size);
  };
  double best_score = best.matched ? score(best) : 0.0;
  const PoseSearchRange range{std::min(kMaxSpeed * guess.seconds, kMaxSearch),
                              radians(kMaxTurnDeg)};
  for (const ScoredPose& start : search_poses(map_, points, T_map_previous, guess.seconds, range,
                                              settings_.voxel_size, kSearchStarts)) {
    const Pose T_previous_current = T_map_previous.inverse() * start.T_map_lidar;
    const MapMatch match = align(
        points, {start.T_map_lidar, start.T_map_lidar, T_previous_current, guess.seconds, true});
    const double match_score = match.matched ? score(match) : 0.0;
    if (match_score <= kClearlyBetter * best_score) continue;
    best = match;
    best_score = match_score;
  }
  return best;
}

// Associates and solves until the pose converges. False when too few points have a surface.
bool Mapper::converge(const Features& points, const PosePrior& prior,
                      const VelocityPrior& velocity_prior, Registration& r) {
  MatchedSurfaces surfaces;
  for (int k = 0; k < settings_.associations; ++k) {
    r.correspondences = map_.match(deskew(points, r.twist), r.pose, settings_.max_distance,
                                   range_noise_, 0, surfaces);
    if (!has_enough_matches(r.correspondences.all, points, settings_)) return false;
    r.scales = robust_scales(r.correspondences, r.pose);
    Sweep sweep{r.pose};
    const LevenbergMarquardtResult result = solve(
        r.correspondences, r.scales, prior, velocity_prior, r.twist, settings_.iterations, sweep);
    r.pose = sweep.T_map_lidar;
    const Vector6 change = velocity_change_in_lidar_axes(sweep);
    r.twist += change;
    apply_velocity_change(r.correspondences.all, change);
    r.iterations += result.iterations;
    if (result.step < kPoseConvergence) break;
  }
  return true;
}

// A direction that many planes and lines constrain needs no test. In the others the registration is
// believed as far as its standard error lets it, beside what the sensor may have accelerated in
// `seconds`.
Localizability Mapper::analyse(const Features& points, const Registration& r, double seconds) {
  const std::vector<Correspondence> shaped = without_points(r.correspondences.all);
  const double scale = *std::max_element(r.scales.begin(), r.scales.end());
  Localizability l = localizability(shaped, r.pose, scale, 0.0);
  const double weak = kWeakShare * static_cast<double>(r.correspondences.all.size());
  const Features deskewed = deskew(points, r.twist);
  const auto certainty = [&](double strength, const Vector6& step, double acceleration) {
    if (strength >= weak) return 1.0;
    const Observability o = observability(map_, deskewed, r.pose, step, range_noise_);
    if (o.significance < settings_.min_significance) return 0.0;
    const double predicted = std::pow(acceleration * seconds * seconds, 2);
    const double registered = std::pow(o.standard_error * step.norm(), 2);
    return predicted > 0.0 ? predicted / (predicted + registered) : 1.0;
  };
  const double angle = settings_.voxel_size / mean_range(r.correspondences.all);
  for (int i = 0; i < 3; ++i) {
    Vector6 step = Vector6::Zero();
    step.head<3>() = settings_.voxel_size * l.translation_axes.col(i);
    l.translation_certainty[i] = certainty(l.translation[i], step, settings_.acceleration);
    l.degenerate_translations += l.translation_certainty[i] == 0.0;
    step.setZero();
    step.tail<3>() = angle * l.rotation_axes.col(i);
    l.rotation_certainty[i] =
        certainty(l.rotation[i], step, radians(settings_.angular_acceleration_deg));
    l.degenerate_rotations += l.rotation_certainty[i] == 0.0;
  }
  return l;
}

MapMatch Mapper::align(const Features& points, const ScanGuess& guess) {
  MapMatch match = unmatched(points, guess, settings_);
  PosePrior prior = pose_prior(guess.T_map_lidar, guess, settings_);
  const VelocityPrior velocity_prior(guess.T_previous_current * guess.T_map_lidar.inverse(),
                                     guess.seconds, settings_.acceleration,
                                     radians(settings_.angular_acceleration_deg));
  Registration r;
  r.pose = guess.T_map_lidar;
  r.twist = velocity_prior.mean(guess.T_map_lidar);
  const bool converged = converge(points, prior, velocity_prior, r);
  match.matches = static_cast<int>(r.correspondences.all.size());
  match.iterations = r.iterations;
  if (!converged) return match;

  match.localizability = analyse(points, r, guess.seconds);
  if (match.localizability.uncertain()) {
    r.pose = predict_where_degenerate(r.pose, guess.T_map_predicted, match.localizability);
    prior = pose_prior(r.pose, guess, settings_);
    prior.fix_degenerate(match.localizability);
    if (!converge(points, prior, velocity_prior, r)) return match;
  }
  NormalEquations<12> solution = sweep_equations(r.correspondences, Sweep{r.pose}, r.scales);
  prior.add_to(solution, r.pose);
  velocity_prior.add_to(solution, Sweep{r.pose}, r.twist);
  // With a guessed pose the residuals say nothing about the sensor.
  if (!match.localizability.degenerate())
    sweep_check_.add(r.correspondences.set(0), r.pose, r.scales[0], velocity_prior.mean(r.pose),
                     r.twist);
  match.matched = true;
  match.matches = static_cast<int>(r.correspondences.all.size());
  match.iterations = r.iterations;
  match.T_map_lidar = normalized(r.pose);
  match.twist = r.twist;
  match.inliers = count_inliers(r.correspondences, r.pose);
  match.rmse = weighted_rmse(r.correspondences, r.pose, r.scales);
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
