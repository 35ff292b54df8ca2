// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "sim/mesh.hpp"
#include "sim/ray_caster.hpp"

namespace lego_loam_sc {

/// A moving object.
struct Mover {
  std::size_t model;                               ///< index of its shape
  std::int64_t from_ns, to_ns;                     ///< time interval of its presence
  std::function<Pose(std::int64_t time_ns)> pose;  ///< T_world_mover; called concurrently
};

/// The shapes (in the frames of their movers) and the movers.
struct TrafficPlan {
  std::vector<Mesh> models;
  std::vector<Mover> movers;
};

/// Casts rays at moving objects.
class Traffic {
 public:
  explicit Traffic(TrafficPlan plan = {});

  /// A mover and its bounding sphere (m, world frame) for some time.
  struct Neighbour {
    const Mover* mover;
    Eigen::Vector3d centre;
    double radius;
  };

  /// Those that a ray of length `reach` (m) from about `origin` may meet at `time_ns` or within
  /// `period_ns` after it, some tenths of a second, with spheres for that time.
  std::vector<Neighbour> near(const Eigen::Vector3d& origin, double reach, std::int64_t time_ns,
                              std::int64_t period_ns) const;

  /// Replaces each hit by a nearer one on a mover, each where it is at `time_ns`.
  void cast(std::span<const Neighbour> neighbours, std::int64_t time_ns,
            const Eigen::Vector3d& origin, std::span<const Eigen::Vector3d> directions,
            double max_range, std::span<std::optional<Hit>> hits) const;

 private:
  struct Model {
    RayCaster shape;
    Eigen::Vector3d centre;  // of a sphere round the shape
    double radius;
  };

  std::vector<Model> models_;
  std::vector<Mover> movers_;
};

}  // namespace lego_loam_sc
