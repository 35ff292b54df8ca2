// SPDX-License-Identifier: BSD-3-Clause
#include "odometry/odometry.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "odometry/association.hpp"
#include "registration/correspondence.hpp"
#include "registration/deskew.hpp"

namespace lego_loam_sc {
namespace {

// Not below two sigmas: lines and planes through single points are as noisy as the points.
constexpr RobustKernel kKernel{.factor = 2.0, .min_scale = 2.0, .max_scale = 50.0};

// Association and solve are repeated until the pose moves by less: 2 mm or 2 mrad. The result is
// an initial guess for the mapper, which is finer.
constexpr double kPoseConvergence = 2e-3;

// Robust sigma of the residuals, m, above which the two scans show different places.
constexpr double kMaxSigma = 0.3;

constexpr std::array<int, 3> kGroundUnknowns = {2, 3, 4};  // t_z, roll, pitch
constexpr std::array<int, 3> kEdgeUnknowns = {0, 1, 5};    // t_x, t_y, yaw
constexpr std::array<int, 6> kAllUnknowns = {0, 1, 2, 3, 4, 5};

// Moves `pose` to the minimum over `unknowns`; the others are held fixed.
template <std::size_t N>
LevenbergMarquardtResult solve(std::span<const Correspondence> correspondences,
                               const std::array<int, N>& unknowns, int max_iterations, Pose& pose) {
  const double scale = robust_scale(correspondences, pose, kKernel);
  return levenberg_marquardt<N>(
      pose, max_iterations,
      [&](const Pose& at) {
        return restrict_to(normal_equations(correspondences, at, scale), unknowns);
      },
      [&](const Pose& at, const Eigen::Matrix<double, N, 1>& step) {
        Vector6 delta = Vector6::Zero();
        delta(unknowns) = step;
        return perturb(at, delta);
      });
}

// Alternates association and solve until the pose converges. `associate(pose)` returns the
// correspondences; fewer than `min_matches` of them are a failure.
template <std::size_t N, class Associate>
bool refine(Associate&& associate, const std::array<int, N>& unknowns, int min_matches,
            int associations, int iterations, Pose& pose, int& total_iterations) {
  for (int k = 0; k < associations; ++k) {
    const std::vector<Correspondence> correspondences = associate(pose);
    if (static_cast<int>(correspondences.size()) < min_matches) return false;
    const auto result = solve(correspondences, unknowns, iterations, pose);
    total_iterations += result.iterations;
    if (result.step < kPoseConvergence) break;
  }
  return true;
}

// Degenerate directions keep the guess: there the solution follows the noise, which does not move.
Pose keep_guess_where_degenerate(const Pose& solved, const Pose& guess, const Localizability& l) {
  const Vector6 delta = perturbation_between(guess, solved);
  return perturb(guess, delta - degenerate_component(l, delta));
}

bool is_ground(const FeaturePoint& point) {
  return point.label == Label::ground;
}

std::vector<FeaturePoint> ground_of(const std::vector<FeaturePoint>& points) {
  std::vector<FeaturePoint> ground;
  std::copy_if(points.begin(), points.end(), std::back_inserter(ground), is_ground);
  return ground;
}

// Scans of different places yield correspondences too, but large residuals.
bool has_small_residuals(const std::vector<Correspondence>& matched, Correspondence::Kind kind,
                         const Pose& pose) {
  std::vector<Correspondence> of_kind;
  std::copy_if(matched.begin(), matched.end(), std::back_inserter(of_kind),
               [&](const Correspondence& c) { return c.kind == kind; });
  return robust_sigma(of_kind, pose) < kMaxSigma;
}

// Accepts or rejects the solved pose by its correspondences and completes `motion`.
void finish(const std::vector<Correspondence>& matched, const Pose& solved, const Pose& guess,
            double min_strength, Motion& motion) {
  for (const Correspondence& c : matched)
    ++(c.kind == Correspondence::Kind::line ? motion.edges : motion.planars);
  motion.solved = has_small_residuals(matched, Correspondence::Kind::line, solved) &&
                  has_small_residuals(matched, Correspondence::Kind::plane, solved);
  if (!motion.solved) return;
  const double scale = robust_scale(matched, solved, kKernel);
  motion.localizability = localizability(matched, solved, scale, min_strength);
  motion.T_previous_current =
      normalized(keep_guess_where_degenerate(solved, guess, motion.localizability));
}

}  // namespace

Odometry::Odometry(const OdometrySettings& settings, double range_noise)
    : settings_(settings), range_noise_(std::max(range_noise, 1e-3)) {}

void Odometry::set_previous(const Features& deskewed) {
  previous_ = Previous{FeatureIndex(deskewed.edges_large),
                       FeatureIndex(ground_of(deskewed.planars_large)), deskewed.planars_large};
}

Motion Odometry::estimate(const Features& features, const Pose& guess, double seconds) const {
  Motion motion;
  motion.T_previous_current = guess;
  if (!previous_) return motion;
  const Previous& previous = *previous_;

  const std::vector<FeaturePoint> edges = subsample(features.edges_sharp, settings_.max_points);
  const std::vector<FeaturePoint> planars = subsample(features.planars_flat, settings_.max_points);
  // Points are de-skewed with the current estimate of the motion.
  const auto edges_at = [&](const Pose& pose) {
    return associate_edges(deskew(edges, log_se3(pose) / seconds), previous.edges, pose, settings_,
                           range_noise_);
  };
  const bool on_ground = std::all_of(planars.begin(), planars.end(), is_ground);
  std::optional<FeatureIndex> all_planars;
  if (!on_ground) all_planars.emplace(previous.planars);
  const FeatureIndex& previous_planars = all_planars ? *all_planars : previous.ground;
  const auto planars_at = [&](const Pose& pose) {
    return associate_planars(deskew(planars, log_se3(pose) / seconds), previous_planars, pose,
                             settings_, range_noise_);
  };
  const auto all_at = [&](const Pose& pose) {
    std::vector<Correspondence> all = planars_at(pose);
    const std::vector<Correspondence> lines = edges_at(pose);
    all.insert(all.end(), lines.begin(), lines.end());
    return all;
  };

  Pose pose = guess;
  if (settings_.two_step && on_ground) {
    motion.solved = refine(planars_at, kGroundUnknowns, settings_.min_planars,
                           settings_.associations, settings_.iterations, pose, motion.iterations) &&
                    refine(edges_at, kEdgeUnknowns, settings_.min_edges, settings_.associations,
                           settings_.iterations, pose, motion.iterations);
    if (motion.solved && settings_.polish_iterations > 0)
      refine(all_at, kAllUnknowns, 6, 1, settings_.polish_iterations, pose, motion.iterations);
  } else {
    motion.solved = refine(all_at, kAllUnknowns, settings_.min_edges + settings_.min_planars,
                           settings_.associations, settings_.iterations, pose, motion.iterations);
  }
  if (motion.solved) finish(all_at(pose), pose, guess, settings_.min_strength, motion);
  return motion;
}

}  // namespace lego_loam_sc
