// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "sim/arch.hpp"
#include "sim/geometry.hpp"
#include "sim/mesh.hpp"
#include "sim/route.hpp"

namespace lego_loam_sc {

/// The rock of a mine, common to all its roadways.
struct Rock {
  Ground floor;        ///< floor height without gravel and ridges
  std::uint64_t seed;  ///< of the roughness
};

/// A mine's roadway, cut along a line with an arched section: 4.7 to 5.5 m wide, 3.3 to 3.9 m high,
/// walls that are rough by 0.1 m (root mean square) at several scales, a gravel floor with the
/// ridges that wheels leave beside their tracks.
class Roadway {
 public:
  /// A place on the line, its direction to the left, and the section there without roughness.
  struct Axis {
    Eigen::Vector3d place;  ///< on the floor
    Eigen::Vector3d left;   ///< horizontal
    Arch section;

    Eigen::Vector3d centre() const { return at(section.centre()); }
    /// A point of the section.
    Eigen::Vector3d at(const Eigen::Vector2d& point) const {
      return place + point.x() * left + point.y() * Eigen::Vector3d::UnitZ();
    }
  };

  /// The line goes through `waypoints` (m) with corners rounded as a Route's; it is closed when it
  /// ends where it starts. `scale` makes a smaller roadway.
  Roadway(std::vector<Eigen::Vector2d> waypoints, double corner_radius, double scale, Rock rock);

  const Route& line() const { return line_; }
  bool closed() const { return waypoints_.front() == waypoints_.back(); }

  /// At a distance (m) along the line.
  Axis axis(double distance) const;

  /// The place of an axis as a pose: x along the line, z up.
  Pose at(double distance) const;

  /// The gravel, `beside` m to the left of the line.
  Eigen::Vector3d floor(const Axis& axis, double beside) const;

  /// The rough wall or roof where a ray from the centre of the section meets it, at an angle as of
  /// Arch.
  Eigen::Vector3d wall(const Axis& axis, double angle) const;

  /// Whether a point lies in the space that was cut, or less than `margin` (m) outside; the floor
  /// is no bound. To be asked beside straight parts of the line only.
  bool contains(const Eigen::Vector3d& point, double margin) const;

 private:
  Axis axis_at(const Eigen::Vector2d& place, const Eigen::Vector2d& left) const;
  double roughness(const Eigen::Vector3d& place) const;

  std::vector<Eigen::Vector2d> waypoints_;
  Route line_;
  double scale_;
  Rock rock_;
};

/// Adds the surface of all the space that the roadways, at most 64, make together. They may meet
/// beside straight parts of their lines; an end that is not in another one is closed by a rock
/// face.
void add_roadways(Mesh& mesh, std::span<const Roadway> roadways);

}  // namespace lego_loam_sc
