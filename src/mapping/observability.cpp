// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/observability.hpp"

#include <algorithm>
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

// The mean of some numbers and its standard error.
class Mean {
 public:
  void add(double x) {
    ++count_;
    sum_ += x;
    squares_ += x * x;
  }
  double value() const { return count_ > 0.0 ? sum_ / count_ : 0.0; }
  double standard_error() const {
    if (count_ < 2.0) return std::numeric_limits<double>::infinity();
    return std::sqrt(std::max(squares_ / count_ - value() * value(), 0.0) / count_);
  }

 private:
  double count_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

}  // namespace

Observability observability(LocalMap& map, const Features& points, const Pose& T_map_lidar,
                            const Vector6& step, double range_noise) {
  const std::vector<double> here = point_costs(map, points, T_map_lidar, range_noise);
  const std::vector<double> ahead =
      point_costs(map, points, perturb(T_map_lidar, step), range_noise);
  const std::vector<double> behind =
      point_costs(map, points, perturb(T_map_lidar, -step), range_noise);
  Mean rise, slope;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const double curvature = ahead[i] + behind[i] - 2.0 * here[i];
    if (std::isnan(curvature)) continue;
    rise.add(curvature);
    slope.add(0.5 * (ahead[i] - behind[i]));
  }
  Observability result;
  if (rise.standard_error() > 0.0) result.significance = rise.value() / rise.standard_error();
  if (rise.value() > 0.0) result.standard_error = slope.standard_error() / rise.value();
  return result;
}

}  // namespace lego_loam_sc
