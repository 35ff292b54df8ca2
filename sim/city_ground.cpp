// SPDX-License-Identifier: BSD-3-Clause
#include "sim/city_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "sim/city_streets.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Rough surfaces return more at a flat angle than the cosine says; their reflectivity makes up for
// it, so that asphalt is seen as far as in recordings.
constexpr double kRoughAsphalt = 0.45, kStone = 0.5, kGrass = 0.5;
constexpr double kRoadBumps = 0.006, kPlotBumps = 0.025;  // m
// Cells of the map across a patch of even ground: near the lanes, and where no lane is near.
constexpr int kPatch = 2, kFarPatch = 8;

// A corner of a patch or a point where a kerb crosses its edge.
struct Point {
  Vector2d place;
  bool on_kerb;
};

// Unevenness that a vehicle rolls over and a lawn has, about 1.
double bump(const Vector2d& p) {
  return std::sin(1.3 * p.x() + 0.4 * p.y()) + std::sin(1.1 * p.y() - 0.5 * p.x() + 1.0) +
         std::sin(0.7 * p.x() + 0.9 * p.y() + 2.0);
}

class GroundBuilder {
 public:
  GroundBuilder(Mesh& mesh, const LaneMap& lanes, const Terrain& terrain)
      : mesh_(mesh), lanes_(lanes), terrain_(terrain) {}

  void build() {
    for (int i = 0; i + 1 < lanes_.columns(); i += kFarPatch)
      for (int j = 0; j + 1 < lanes_.rows(); j += kFarPatch) add_patch(i, j, kFarPatch);
  }

 private:
  // A square of `size` cells, as one when it is even ground, else divided.
  void add_patch(int i0, int j0, int size) {
    const int i1 = std::min(i0 + size, lanes_.columns() - 1);
    const int j1 = std::min(j0 + size, lanes_.rows() - 1);
    if (i1 <= i0 || j1 <= j0) return;
    const auto [nearest, farthest] = distances(i0, j0, i1, j1);
    const double even = size == kFarPatch ? kFenceLine + 2.0 : kKerbLine;
    const bool is_even = nearest >= even || (size == kPatch && farthest < kKerbLine);
    if (is_even || size == 1)
      add_cell(i0, j0, i1, j1);
    else
      for (int i = i0; i < i1; i += size / 2)
        for (int j = j0; j < j1; j += size / 2) add_patch(i, j, size / 2);
  }

  std::pair<double, double> distances(int i0, int j0, int i1, int j1) const {
    double nearest = lanes_.distance(i0, j0), farthest = nearest;
    for (int i = i0; i <= i1; ++i) {
      for (int j = j0; j <= j1; ++j) {
        nearest = std::min(nearest, lanes_.distance(i, j));
        farthest = std::max(farthest, lanes_.distance(i, j));
      }
    }
    return {nearest, farthest};
  }

  void add_cell(int i0, int j0, int i1, int j1) {
    const std::array<std::array<int, 2>, 4> corners = {{{i0, j0}, {i1, j0}, {i1, j1}, {i0, j1}}};
    std::vector<Point> road, raised;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [i, j] = corners[k];
      const auto [ni, nj] = corners[(k + 1) % 4];
      const double here = lanes_.distance(i, j) - kKerbLine;
      const double next = lanes_.distance(ni, nj) - kKerbLine;
      const Vector2d place = lanes_.corner(i, j), next_place = lanes_.corner(ni, nj);
      (here < 0.0 ? road : raised).push_back({place, false});
      if ((here < 0.0) == (next < 0.0)) continue;
      const Point crossing{place + here / (here - next) * (next_place - place), true};
      road.push_back(crossing);
      raised.push_back(crossing);
    }
    const bool plot = lanes_.distance(i0, j0) > kFenceLine;
    add_polygon(road, 0.0, kRoadBumps, kRoughAsphalt);
    add_polygon(raised, kKerbHeight, plot ? kPlotBumps : kRoadBumps, plot ? kGrass : kStone);
    for (std::size_t k = 0; k < raised.size(); ++k) {
      const Point& a = raised[k];
      const Point& b = raised[(k + 1) % raised.size()];
      if (a.on_kerb && b.on_kerb)
        add_quad(mesh_,
                 {on_ground(a.place, 0.0, kRoadBumps), on_ground(b.place, 0.0, kRoadBumps),
                  on_ground(b.place, kKerbHeight, kRoadBumps),
                  on_ground(a.place, kKerbHeight, kRoadBumps)},
                 kStone);
    }
  }

  Vector3d on_ground(const Vector2d& place, double raised, double bumps) const {
    return {place.x(), place.y(), terrain_.height(place) + raised + bumps * bump(place)};
  }

  void add_polygon(const std::vector<Point>& points, double raised, double bumps,
                   double reflectivity) {
    if (points.size() < 3) return;
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const Point& point : points)
      mesh_.vertices.emplace_back(on_ground(point.place, raised, bumps).cast<float>());
    for (std::uint32_t k = 2; k < points.size(); ++k) {
      mesh_.triangles.push_back({first, first + k - 1, first + k});
      mesh_.reflectivity.push_back(static_cast<float>(reflectivity));
    }
  }

  Mesh& mesh_;
  const LaneMap& lanes_;
  const Terrain& terrain_;
};

}  // namespace

void add_city_ground(Mesh& mesh, const LaneMap& lanes, const Terrain& terrain) {
  GroundBuilder(mesh, lanes, terrain).build();
}

}  // namespace lego_loam_sc
