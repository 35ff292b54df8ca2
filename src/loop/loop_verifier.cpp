// SPDX-License-Identifier: BSD-3-Clause
#include "loop/loop_verifier.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "features/features.hpp"
#include "map/local_map.hpp"
#include "map/voxel_filter.hpp"
#include "registration/correspondence.hpp"
#include "registration/localizability.hpp"

namespace lego_loam_sc {
namespace {

// Reach of a correspondence, in voxels of its level: a surface spans two.
constexpr double kReachVoxels = 1.5;
// Wide: a guess may be metres off.
constexpr RobustKernel kKernel{.factor = 2.0, .min_scale = 1.0, .max_scale = 80.0};

void append(const std::vector<FeaturePoint>& points, const Eigen::Isometry3f& T_frame_key,
            std::vector<FeaturePoint>& cloud) {
  for (FeaturePoint point : points) {
    point.position = T_frame_key * point.position;
    cloud.push_back(point);
  }
}

Features merge(std::span<const PlacedKeyFrame> key_frames) {
  Features merged;
  for (const PlacedKeyFrame& placed : key_frames) {
    const Eigen::Isometry3f T = placed.T_frame_key.cast<float>();
    for (const auto set : kMapSets) append(placed.features.*set, T, merged.*set);
  }
  return merged;
}

double overlap(const Features& query, LocalMap& map, const Pose& pose) {
  std::size_t inside = 0;
  std::size_t all = 0;
  for (const auto set : kMapSets) {
    all += (query.*set).size();
    for (const FeaturePoint& p : query.*set)
      inside += map.occupied(pose * p.position.cast<double>());
  }
  return all > 0 ? static_cast<double>(inside) / static_cast<double>(all) : 0.0;
}

// Iterated closest point, point to plane and point to line, on one voxel level after the other.
Pose register_coarse_to_fine(const Features& query, LocalMap& map, Pose pose, double range_noise,
                             const VerifierSettings& settings) {
  for (int level = settings.levels - 1; level >= 0; --level) {
    const double reach = kReachVoxels * settings.voxel_size * (1 << level);
    MatchedSurfaces surfaces;
    for (int k = 0; k < settings.iterations; ++k) {
      const auto correspondences = map.match(query, pose, reach, range_noise, level, surfaces).all;
      if (std::ssize(correspondences) < settings.min_matches) break;
      const double scale = robust_scale(correspondences, pose, kKernel);
      const auto result = levenberg_marquardt<6>(
          pose, 2, [&](const Pose& at) { return normal_equations(correspondences, at, scale); },
          perturb);
      if (result.step < kStepConvergence) break;
    }
  }
  return normalized(pose);
}

bool is_plausible(const Pose& T_match_query, const VerifierSettings& settings) {
  const Eigen::Vector3d up = T_match_query.linear().col(2);
  const double tilt = std::acos(std::clamp(up.z(), -1.0, 1.0));
  return std::abs(T_match_query.translation().z()) <= settings.max_height_difference &&
         tilt <= radians(settings.max_tilt_deg);
}

LoopVerification judge(const Features& query, LocalMap& map, const Pose& pose, double range_noise,
                       const VerifierSettings& settings) {
  LoopVerification result;
  result.T_match_query = pose;
  result.overlap = overlap(query, map, pose);
  MatchedSurfaces surfaces;
  const auto correspondences =
      map.match(query, pose, kReachVoxels * settings.voxel_size, range_noise, 0, surfaces).all;
  if (std::ssize(correspondences) < settings.min_matches) return result;

  const double scale = robust_scale(correspondences, pose, kKernel);
  const NormalEquations<6> equations = normal_equations(correspondences, pose, scale);
  // The mean of a cloud of points is no surface to be off from.
  double sum = 0.0, count = 0.0;
  for (const Correspondence& c : correspondences) {
    if (c.kind == Correspondence::Kind::point) continue;
    const double d = distance(c, pose);
    sum += d * d;
    ++count;
  }
  result.rmse = count > 0.0 ? std::sqrt(sum / count) : 0.0;
  result.covariance = (equations.H + Matrix6::Identity()).inverse();

  if (result.overlap < settings.min_overlap) {
    result.verdict = Verdict::low_overlap;
  } else if (result.rmse > settings.max_rmse) {
    result.verdict = Verdict::high_rmse;
  } else if (!is_plausible(pose, settings)) {
    result.verdict = Verdict::implausible;
  } else if (localizability(correspondences, pose, scale, settings.min_strength).degenerate()) {
    result.verdict = Verdict::degenerate;
  } else {
    result.verdict = Verdict::accepted;
  }
  return result;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::accepted: return "accepted";
    case Verdict::no_candidate: return "no_candidate";
    case Verdict::no_match: return "no_match";
    case Verdict::low_overlap: return "low_overlap";
    case Verdict::high_rmse: return "high_rmse";
    case Verdict::implausible: return "implausible";
    case Verdict::degenerate: return "degenerate";
    case Verdict::inconsistent: return "inconsistent";
    case Verdict::contradicted: return "contradicted";
  }
  return "unknown";
}

LoopVerification verify_loop(std::span<const PlacedKeyFrame> query,
                             std::span<const PlacedKeyFrame> match,
                             std::span<const Pose> guesses_T_match_query, double range_noise,
                             const VerifierSettings& settings) {
  LocalMap map(settings.voxel_size, settings.levels, settings.planarity);
  map.insert(merge(match), Pose::Identity());
  const Features source = voxel_filter(merge(query), 2.0 * settings.voxel_size);

  LoopVerification best;
  for (const Pose& guess : guesses_T_match_query) {
    const Pose pose = register_coarse_to_fine(source, map, guess, range_noise, settings);
    const LoopVerification result = judge(source, map, pose, range_noise, settings);
    if (&guess == guesses_T_match_query.data() || result.overlap > best.overlap) best = result;
  }
  return best;
}

}  // namespace lego_loam_sc
