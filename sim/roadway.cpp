// SPDX-License-Identifier: BSD-3-Clause
#include "sim/roadway.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "sim/geometry.hpp"
#include "sim/noise.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRing = 0.25;                      // m from ring to ring of vertices
constexpr std::size_t kOnFloor = 24, kOnWall = 48;  // vertices of a ring
constexpr std::size_t kFaceRings = 7;               // that close an end
constexpr double kRock = 0.15, kGravel = 0.12;      // reflectivity

struct Octave {
  double size, height;  // m
};
constexpr std::array<Octave, 3> kRoughness = {{{4.0, 0.22}, {1.5, 0.14}, {0.6, 0.07}}};
constexpr Octave kGravelNoise = {0.4, 0.02};

double octave(const Octave& o, const Vector3d& place, std::uint64_t seed) {
  return o.height * smooth_noise(place / o.size, seed);
}

Vector3d on_plan(const Vector2d& place, double z = 0.0) {
  return {place.x(), place.y(), z};
}

// What wheels have pushed aside, at a distance from the line: nothing where they run and nothing at
// the walls, where roadways meet.
double ridge(double beside) {
  const auto bell = [](double x) { return std::exp(-x * x); };
  return 0.05 * bell(beside / 0.3) + 0.06 * bell((std::abs(beside) - 1.1) / 0.2);
}

enum class Part { kFloor, kFoot, kWall };  // a foot belongs to floor and wall

// The other roadways, as bits, into which a roadway's surface opens at a vertex.
struct Openings {
  std::uint64_t wall = 0;
  std::uint64_t floor = 0;  // only one of two roadways that meet has the floor between them
};

struct Vertex {
  Vector3d place;
  Part part;
  Openings openings = {};
};
using Ring = std::array<Vertex, kOnFloor + kOnWall>;

// From the right foot along the floor to the left one and back over the roof.
Ring ring_of(const Roadway& roadway, double distance) {
  const Roadway::Axis axis = roadway.axis(distance);
  const double half_width = axis.section.half_width;
  Ring ring;
  for (std::size_t i = 0; i < kOnFloor; ++i) {
    const double u = static_cast<double>(i) / (kOnFloor - 1);
    const bool foot = i == 0 || i + 1 == kOnFloor;
    ring[i] = {roadway.floor(axis, half_width * (2.0 * u - 1.0)),
               foot ? Part::kFoot : Part::kFloor};
  }
  const double left = axis.section.floor_angle(), right = std::numbers::pi - left;
  for (std::size_t i = 0; i < kOnWall; ++i) {
    const double u = static_cast<double>(i + 1) / (kOnWall + 1);
    ring[kOnFloor + i] = {roadway.wall(axis, left + u * (right - left)), Part::kWall};
  }
  return ring;
}

// The ring shrunk towards its centre: a rock face in pieces.
Ring face_ring(const Roadway& roadway, double distance, std::size_t step) {
  const double size = static_cast<double>(step) / kFaceRings;
  const Vector3d centre = roadway.axis(distance).centre();
  Ring ring = ring_of(roadway, distance);
  for (Vertex& vertex : ring) vertex = {centre + size * (vertex.place - centre), Part::kWall};
  return ring;
}

// The surface of a roadway as a tube, from face to face.
std::vector<Ring> rings_of(const Roadway& roadway) {
  const double length = roadway.line().length();
  const auto pieces = static_cast<std::size_t>(std::ceil(length / kRing));
  std::vector<Ring> rings;
  if (!roadway.closed())
    for (std::size_t i = 0; i < kFaceRings; ++i) rings.push_back(face_ring(roadway, 0.0, i));
  for (std::size_t i = 0; i <= pieces; ++i)
    rings.push_back(
        ring_of(roadway, length * static_cast<double>(i) / static_cast<double>(pieces)));
  if (!roadway.closed())
    for (std::size_t i = kFaceRings; i-- > 0;) rings.push_back(face_ring(roadway, length, i));
  return rings;
}

Openings openings_at(const Vector3d& place, std::span<const Roadway> roadways, std::size_t self) {
  constexpr double kFloorOverlap = 0.8;  // m; no gap opens between two floors
  Openings openings;
  for (std::size_t i = 0; i < roadways.size(); ++i) {
    if (i == self || !roadways[i].contains(place, 0.0)) continue;
    openings.wall |= std::uint64_t{1} << i;
    if (i < self && roadways[i].contains(place, -kFloorOverlap))
      openings.floor |= std::uint64_t{1} << i;
  }
  return openings;
}

bool is_open(const std::array<const Vertex*, 3>& triangle, bool on_floor) {
  std::uint64_t common = ~std::uint64_t{0};
  for (const Vertex* v : triangle) common &= on_floor ? v->openings.floor : v->openings.wall;
  return common != 0;
}

// The triangles between the rings, but for those that open into one and the same other roadway.
void add_tube(Mesh& mesh, const std::vector<Ring>& rings) {
  const std::size_t first = mesh.vertices.size(), ring_size = rings.front().size();
  for (const Ring& ring : rings)
    for (const Vertex& vertex : ring) mesh.vertices.emplace_back(vertex.place.cast<float>());
  const auto add_triangle = [&](const std::array<std::size_t, 3>& corners) {
    std::array<const Vertex*, 3> triangle;
    for (std::size_t i = 0; i < 3; ++i)
      triangle[i] = &rings[corners[i] / ring_size][corners[i] % ring_size];
    const bool on_floor = std::ranges::none_of(
        triangle, [](const Vertex* vertex) { return vertex->part == Part::kWall; });
    if (is_open(triangle, on_floor)) return;
    auto& indices = mesh.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) indices[i] = static_cast<std::uint32_t>(first + corners[i]);
    mesh.reflectivity.push_back(static_cast<float>(on_floor ? kGravel : kRock));
  };
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    for (std::size_t j = 0; j < ring_size; ++j) {
      const std::size_t a = i * ring_size + j, b = i * ring_size + (j + 1) % ring_size;
      add_triangle({a, b, b + ring_size});
      add_triangle({a, b + ring_size, a + ring_size});
    }
  }
}

}  // namespace

Roadway::Roadway(std::vector<Vector2d> waypoints, double corner_radius, double scale, Rock rock)
    : waypoints_(std::move(waypoints)),
      line_(waypoints_, corner_radius),
      scale_(scale),
      rock_(std::move(rock)) {}

Roadway::Axis Roadway::axis_at(const Vector2d& place, const Vector2d& left) const {
  const double wider = smooth_noise(on_plan(place) / 15.0, rock_.seed + 1);
  const double higher = smooth_noise(on_plan(place) / 20.0, rock_.seed + 2);
  return {on_plan(place, rock_.floor(place.x(), place.y())),
          on_plan(left),
          {scale_ * (2.55 + 0.2 * wider), scale_ * 1.7, scale_ * (1.9 + 0.3 * higher)}};
}

Roadway::Axis Roadway::axis(double distance) const {
  const Route::Point point = line_.at(distance);
  return axis_at(point.position, left_of(point.direction));
}

Pose Roadway::at(double distance) const {
  const Axis here = axis(distance);
  return Eigen::Translation3d(here.place) *
         Eigen::AngleAxisd(std::atan2(-here.left.x(), here.left.y()), Vector3d::UnitZ());
}

double Roadway::roughness(const Vector3d& place) const {
  double sum = 0.0;
  for (const Octave& o : kRoughness) sum += octave(o, place, rock_.seed);
  return sum;
}

Vector3d Roadway::floor(const Axis& axis, double beside) const {
  const Vector2d place = (axis.place + beside * axis.left).head<2>();
  return on_plan(place, rock_.floor(place.x(), place.y()) + ridge(beside) +
                            octave(kGravelNoise, on_plan(place), rock_.seed + 3));
}

Vector3d Roadway::wall(const Axis& axis, double angle) const {
  const Vector3d smooth = axis.at(axis.section.at(angle));
  return smooth + roughness(smooth) * (smooth - axis.centre()).normalized();
}

bool Roadway::contains(const Vector3d& point, double margin) const {
  constexpr double kFar = 4.0;  // m; no roadway reaches so far from its line
  double nearest = kFar;
  Vector2d place, left;
  double beside = 0.0;
  for (std::size_t i = 0; i + 1 < waypoints_.size(); ++i) {
    const Vector2d leg = waypoints_[i + 1] - waypoints_[i];
    const Vector2d along = leg.normalized();
    const Vector2d offset = point.head<2>() - waypoints_[i];
    const double distance = offset.dot(along), across = offset.dot(left_of(along));
    if (distance < -margin || distance > leg.norm() + margin || std::abs(across) >= nearest)
      continue;
    nearest = std::abs(across);
    beside = across;
    place = waypoints_[i] + distance * along;
    left = left_of(along);
  }
  if (nearest == kFar) return false;
  const Axis axis = axis_at(place, left);
  const Arch& section = axis.section;
  const double up = point.z() - axis.centre().z();
  // Beside and below the floor's ends the floor is no bound.
  if (-up * section.half_width >= nearest * section.wall)
    return nearest < section.half_width + margin;
  const double angle = std::atan2(up, beside);
  const double reach = section.radius(angle) + roughness(axis.at(section.at(angle)));
  return std::hypot(up, beside) < reach + margin;
}

void add_roadways(Mesh& mesh, std::span<const Roadway> roadways) {
  for (std::size_t self = 0; self < roadways.size(); ++self) {
    std::vector<Ring> rings = rings_of(roadways[self]);
    for (Ring& ring : rings)
      for (Vertex& vertex : ring) vertex.openings = openings_at(vertex.place, roadways, self);
    add_tube(mesh, rings);
  }
}

}  // namespace lego_loam_sc
