// SPDX-License-Identifier: BSD-3-Clause
#include "sim/traffic.hpp"

#include <algorithm>
#include <utility>

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr double kOwnMotion = 6.0;  // m that the sensor moves in a sweep at most
constexpr double kBending = 0.5;    // m by which a mover leaves the straight line in a sweep

bool passes_near(const Vector3d& direction, const Vector3d& to_centre, double radius) {
  const double along = direction.dot(to_centre);
  const double squared = to_centre.squaredNorm();
  return squared < radius * radius || (along > 0.0 && squared - along * along < radius * radius);
}

}  // namespace

Traffic::Traffic(TrafficPlan plan) : movers_(std::move(plan.movers)) {
  for (const Mesh& mesh : plan.models) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(vertex);
    models_.push_back(
        {RayCaster(mesh), box.center().cast<double>(), 0.5 * box.diagonal().cast<double>().norm()});
  }
}

std::vector<Traffic::Neighbour> Traffic::near(const Vector3d& origin, double reach,
                                              std::int64_t time_ns, std::int64_t period_ns) const {
  std::vector<Neighbour> result;
  for (const Mover& mover : movers_) {
    if (mover.to_ns < time_ns || mover.from_ns > time_ns + period_ns) continue;
    const Model& model = models_[mover.model];
    const Vector3d first = mover.pose(time_ns) * model.centre;
    const Vector3d last = mover.pose(time_ns + period_ns) * model.centre;
    const Vector3d centre = 0.5 * (first + last);
    const double radius = model.radius + 0.5 * (last - first).norm() + kBending;
    if ((centre - origin).norm() < reach + radius + kOwnMotion)
      result.push_back({&mover, centre, radius});
  }
  return result;
}

void Traffic::cast(std::span<const Neighbour> neighbours, std::int64_t time_ns,
                   const Vector3d& origin, std::span<const Vector3d> directions, double max_range,
                   std::span<std::optional<Hit>> hits) const {
  for (const auto& [mover, centre, radius] : neighbours) {
    if (time_ns < mover->from_ns || time_ns > mover->to_ns) continue;
    if (std::ranges::none_of(directions, [&](const Vector3d& direction) {
          return passes_near(direction, centre - origin, radius);
        }))
      continue;
    const Pose T_mover_world = mover->pose(time_ns).inverse();
    std::vector<Vector3d> turned;
    for (const Vector3d& direction : directions)
      turned.emplace_back(T_mover_world.linear() * direction);
    std::vector<std::optional<Hit>> found(directions.size());
    models_[mover->model].shape.cast(T_mover_world * origin, turned, max_range, found);
    for (std::size_t i = 0; i < hits.size(); ++i)
      if (found[i] && (!hits[i] || found[i]->range < hits[i]->range)) hits[i] = found[i];
  }
}

}  // namespace lego_loam_sc
