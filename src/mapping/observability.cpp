// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/observability.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace lego_loam_sc {
namespace {

// Residual, sigmas, at which a point has half of its greatest cost, so that outliers count no more
// than other points.
constexpr double kHalfCost = 3.0;

// The cost of each point, from 0 to 1; NaN for a point without a surface.
std::vector<double> point_costs(LocalMap& map, const Features& points, const Pose& T_map_lidar,
                                double range_noise) {
  MatchedSurfaces found;
  map.match(points, T_map_lidar, std::numeric_limits<double>::max(), range_noise, 0, found);
  std::vector<double> costs;
  const auto add = [&](const std::vector<FeaturePoint>& set,
                       const std::vector<MatchedSurfaces::Entry>& entries) {
    for (std::size_t i = 0; i < set.size(); ++i) {
      const Surface& surface = entries[i].surface;
      if (surface.kind == Surface::Kind::none) {
        costs.push_back(std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      const Correspondence c = correspondence_with(surface, set[i], range_noise);
      const double d = distance(c, T_map_lidar);
      const double squared = d * d * c.weight;
      costs.push_back(squared / (squared + kHalfCost * kHalfCost));
    }
  };
  add(points.planars_large, found.planes);
  add(points.edges_large, found.lines);
  add(points.scattered, found.scattered);
  return costs;
}

}  // namespace

double significance(LocalMap& map, const Features& points, const Pose& T_map_lidar,
                    const Vector6& step, double range_noise) {
  const std::vector<double> here = point_costs(map, points, T_map_lidar, range_noise);
  const std::vector<double> ahead =
      point_costs(map, points, perturb(T_map_lidar, step), range_noise);
  const std::vector<double> behind =
      point_costs(map, points, perturb(T_map_lidar, -step), range_noise);
  double count = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const double rise = ahead[i] + behind[i] - 2.0 * here[i];
    if (std::isnan(rise)) continue;
    ++count;
    sum += rise;
    squares += rise * rise;
  }
  if (count < 2.0) return 0.0;
  const double mean = sum / count;
  const double variance = squares / count - mean * mean;
  return variance > 0.0 ? mean / std::sqrt(variance / count) : 0.0;
}

}  // namespace lego_loam_sc
