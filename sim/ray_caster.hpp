// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/mesh.hpp"

namespace lego_loam_sc {

/// The first intersection of a ray.
struct Hit {
  double range;          ///< m
  double cos_incidence;  ///< cosine of the angle between the ray and the surface normal, 0 to 1
  double reflectivity;   ///< of the surface, 0 to 1
};

/// Finds the first triangle on a ray. The only place that uses Embree, which finds the triangle in
/// single precision; the range is computed in double precision from its plane.
class RayCaster {
 public:
  /// Throws std::runtime_error when Embree cannot hold the mesh.
  explicit RayCaster(const Mesh& mesh);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;

  /// The first hit within `max_range` (m) of a ray in world coordinates, or nothing. `direction`
  /// has length 1. May be called concurrently.
  std::optional<Hit> cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                          double max_range) const;

  /// The same for rays from one origin, `hits[i]` for `directions[i]`: three times as fast when
  /// neighbouring rays are close together.
  void cast(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3d> directions,
            double max_range, std::span<std::optional<Hit>> hits) const;

 private:
  struct Scene;
  struct Surface {  // of a triangle: the points with normal * point = offset
    Eigen::Vector3d normal;
    double offset;
    float reflectivity;
  };

  std::optional<Hit> hit_on(unsigned triangle, const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction, float found_range) const;

  std::vector<Surface> surfaces_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace lego_loam_sc
