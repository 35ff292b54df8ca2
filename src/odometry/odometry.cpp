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

// The kernel's scale in robust spreads of the residuals, and its limits in their sigmas.
constexpr double kKernelSpreads = 2.0;
constexpr double kMinScale = 2.0;
constexpr double kMaxScale = 50.0;

// Correspondences are searched anew until a solve moves the pose by less: 2 mm or 2 mrad. The
// result is a guess for the mapper, which is finer.
constexpr double kStill = 2e-3;

// Robust sigma of the distances, m, above which two scans do not show the same place.
constexpr double kMaxSpread = 0.3;

constexpr std::array<int, 3> kGroundUnknowns = {2, 3, 4};  // t_z, roll, pitch
constexpr std::array<int, 3> kEdgeUnknowns = {0, 1, 5};    // t_x, t_y, yaw
constexpr std::array<int, 6> kAllUnknowns = {0, 1, 2, 3, 4, 5};

// Moves `pose` to the minimum over `unknowns`; the others stay as they are.
template <std::size_t N>
LevenbergMarquardtResult solve(std::span<const Correspondence> correspondences,
                               const std::array<int, N>& unknowns, int max_iterations, Pose& pose) {
  const double scale = robust_scale(correspondences, pose, kKernelSpreads, kMinScale, kMaxScale);
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

// Searches correspondences anew and solves until the pose stands still. `associate(pose)` returns
// the correspondences, fewer than `needed` of them mean failure.
template <std::size_t N, class Associate>
bool refine(Associate&& associate, const std::array<int, N>& unknowns, int needed, int associations,
            int iterations, Pose& pose, int& total_iterations) {
  for (int k = 0; k < associations; ++k) {
    const std::vector<Correspondence> correspondences = associate(pose);
    if (static_cast<int>(correspondences.size()) < needed) return false;
    const auto result = solve(correspondences, unknowns, iterations, pose);
    total_iterations += result.iterations;
    if (result.step < kStill) break;
  }
  return true;
}

// Directions that the features do not hold keep the guess: the motion goes on instead of freezing.
Pose keep_guess_where_degenerate(const Pose& solved, const Pose& guess, const Localizability& l) {
  Eigen::Vector3d translation = solved.translation() - guess.translation();
  Eigen::Vector3d rotation = log_so3(solved.linear() * guess.linear().transpose());
  for (int i = 0; i < l.degenerate_translations; ++i)
    translation -= l.translation_axes.col(i) * l.translation_axes.col(i).dot(translation);
  for (int i = 0; i < l.degenerate_rotations; ++i)
    rotation -= l.rotation_axes.col(i) * l.rotation_axes.col(i).dot(rotation);
  Vector6 delta;
  delta << translation, rotation;
  return perturb(guess, delta);
}

// At most `count` of the points, at equal steps.
std::vector<FeaturePoint> evenly(const std::vector<FeaturePoint>& points, int count) {
  const auto wanted = static_cast<std::size_t>(count);
  if (points.size() <= wanted) return points;
  std::vector<FeaturePoint> taken(wanted);
  for (std::size_t i = 0; i < wanted; ++i) taken[i] = points[i * points.size() / wanted];
  return taken;
}

bool is_ground(const FeaturePoint& point) {
  return point.label == Label::ground;
}

std::vector<FeaturePoint> ground_of(const std::vector<FeaturePoint>& points) {
  std::vector<FeaturePoint> ground;
  std::copy_if(points.begin(), points.end(), std::back_inserter(ground), is_ground);
  return ground;
}

// Something is always near enough to be matched, even in a scan of another place; but then the
// distances that remain are large.
bool fits(const std::vector<Correspondence>& matched, Correspondence::Kind kind, const Pose& pose) {
  std::vector<Correspondence> of_kind;
  std::copy_if(matched.begin(), matched.end(), std::back_inserter(of_kind),
               [&](const Correspondence& c) { return c.kind == kind; });
  return spread(of_kind, pose) < kMaxSpread;
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

  const std::vector<FeaturePoint> edges = evenly(features.edges_sharp, settings_.max_points);
  const std::vector<FeaturePoint> planars = evenly(features.planars_flat, settings_.max_points);
  // The points of a sweep are moved to its middle with the motion as estimated so far.
  const auto edges_at = [&](const Pose& pose) {
    return associate_edges(deskew(edges, log_se3(pose) / seconds), previous.edges, pose, settings_,
                           range_noise_);
  };
  const bool on_ground = std::all_of(planars.begin(), planars.end(), is_ground);
  std::optional<FeatureIndex> everywhere;
  if (!on_ground) everywhere.emplace(previous.planars);
  const FeatureIndex& previous_planars = everywhere ? *everywhere : previous.ground;
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
  if (!motion.solved) return motion;

  const std::vector<Correspondence> matched = all_at(pose);
  for (const Correspondence& c : matched)
    ++(c.kind == Correspondence::Kind::line ? motion.edges : motion.planars);
  motion.solved = fits(matched, Correspondence::Kind::line, pose) &&
                  fits(matched, Correspondence::Kind::plane, pose);
  if (!motion.solved) return motion;
  const double scale = robust_scale(matched, pose, kKernelSpreads, kMinScale, kMaxScale);
  motion.localizability = localizability(matched, pose, scale, settings_.min_strength);
  motion.T_previous_current =
      normalized(keep_guess_where_degenerate(pose, guess, motion.localizability));
  return motion;
}

}  // namespace lego_loam_sc
