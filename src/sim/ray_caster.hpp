// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "sim/mesh.hpp"

namespace lego_loam_sc {

/// What a ray met first.
struct Hit {
  double range;          ///< m
  double cos_incidence;  ///< cosine of the angle between the ray and the surface normal, 0 to 1
  double reflectivity;   ///< of the surface, 0 to 1
};

/// Finds the first triangle on a ray. The only place that knows Embree, which only picks the
/// triangle, in single precision; the range is computed in double precision from its plane.
class RayCaster {
 public:
  /// @throws std::runtime_error when Embree cannot hold the mesh.
  explicit RayCaster(Mesh mesh);
  ~RayCaster();

  /// The first hit within `max_range` (m) of a ray in world coordinates, or nothing. `direction`
  /// has length 1. May be called from many threads at once.
  std::optional<Hit> cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                          double max_range) const;

 private:
  struct Scene;
  Mesh mesh_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace lego_loam_sc
