// SPDX-License-Identifier: BSD-3-Clause
#include "sim/city_lots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/facade.hpp"
#include "sim/materials.hpp"
#include "sim/occupancy.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPlaster = 0.45;  // reflectivity
constexpr double kRoom = 1.45;     // m between the middle of a lane and a parked car
constexpr double kBackRow = 22.0;  // m between the fence line and the second row of houses
constexpr double kGarden = 11.0;   // m between the trees behind the houses
constexpr double kSight = 90.0;    // m from a street within which gardens are planted

// One side of a street: x along it in the direction of the lane there, y away from the lane.
struct Side {
  Polyline lane;  // in that direction

  double length() const { return static_cast<double>(lane.size() - 1); }

  Vector2d along(double x) const {
    const auto i = static_cast<std::size_t>(x);
    return (lane[std::min(i + 2, lane.size() - 1)] - lane[i > 1 ? i - 1 : 0]).normalized();
  }
  Vector2d away(double x) const {
    const Vector2d a = along(x);
    return {a.y(), -a.x()};
  }
  Vector2d at(double x, double y) const {
    const auto i = std::min(static_cast<std::size_t>(x), lane.size() - 2);
    const double t = x - static_cast<double>(i);
    return (1.0 - t) * lane[i] + t * lane[i + 1] + y * away(x);
  }
};

std::array<Side, 2> sides_of(const Street& street) {
  Polyline left = shifted(street.line, street.left);
  std::ranges::reverse(left);
  return {{{shifted(street.line, -street.right)}, {std::move(left)}}};
}

class LotBuilder {
 public:
  LotBuilder(Mesh& mesh, const LaneMap& lanes, const Terrain& terrain)
      : mesh_(mesh), terrain_(terrain), taken_(lanes), lanes_(lanes) {}

  void add_parked_cars(const Side& side, Random random) {
    for (double x = random.uniform(0.0, 6.0); x < side.length(); x += random.uniform(5.6, 7.0)) {
      const double y = kParkedCar + random.uniform(-0.05, 0.15);
      if (!random.chance(0.5)) continue;
      if (!taken_.take({side.at(x, y), side.along(x), 5.2, 2.0}, kRoom)) continue;
      const Vector2d front = random.chance(0.9) ? side.along(x) : Vector2d(-side.along(x));
      add_car(mesh_, on_slope(side.at(x, y), front, 0.0), random);
    }
  }

  void add_verge(const Side& side, Random random) {
    for (double x = random.uniform(0.0, 12.0); x < side.length(); x += random.uniform(4.0, 11.0)) {
      const Vector2d place = side.at(x, kVerge);
      if (!taken_.take({place, side.along(x), 1.0, 0.5}, kVerge - 0.3)) continue;
      const double kind = random.uniform();
      const Pose facing_lane = upright(place, -side.away(x), kKerbHeight);
      if (kind < 0.45)
        add_tree(mesh_, facing_lane, random);
      else if (kind < 0.6)
        add_lamp(mesh_, facing_lane);
      else if (kind < 0.75)
        add_sign(mesh_, upright(place, -side.along(x), kKerbHeight));
      else
        add_cylinder(mesh_, facing_lane * Eigen::Translation3d(0.0, 0.0, -0.1), 0.06, 1.1, kSteel);
    }
  }

  // A row of houses with its gardens, `behind` (m) the fence line.
  void add_houses(const Side& side, double behind, double density, Random random) {
    for (double x = 2.0; x < side.length() - 10.0;) {
      const House house{.width = random.uniform(8.0, 16.0),
                        .depth = random.uniform(9.0, 12.0),
                        .storeys = random.chance(0.6) ? 2 : 3};
      const double setback =
          random.chance(0.45) ? random.uniform(0.0, 1.0) : random.uniform(2.0, 5.5);
      const double middle = x + 0.5 * house.width;
      if (middle > side.length()) break;
      const double front = kFenceLine + 0.3 + behind + setback;
      const Footprint footprint{side.at(middle, front + 0.5 * house.depth), side.along(middle),
                                house.width, house.depth};
      if (!random.chance(density) || !taken_.take(footprint, kFenceLine + 0.2)) {
        x += random.uniform(1.5, 3.0);
        continue;
      }
      add_house(mesh_, on_level(footprint, side.away(middle)), house, random);
      x += house.width + (random.chance(0.45) ? random.uniform(2.5, 7.0) : 0.6);
    }
  }

  // What closes the plots towards the street where no house stands on the fence line.
  void add_fences(const Side& side, Random random) {
    int kind = 0;
    double height = 1.0;
    for (double x = 2.0; x < side.length() - 2.0; x += 3.1) {
      if (random.chance(0.15)) {
        kind = static_cast<int>(random.uniform(0.0, 4.0));
        height = random.uniform(0.5, 1.9);
        x += 3.0;  // a gate
        continue;
      }
      const Vector2d place = side.at(x, kFenceLine + 0.35);
      if (kind == 3 || !taken_.take({place, side.along(x), 2.6, 0.3}, kFenceLine - 0.1)) continue;
      const Pose pose = on_slope(place, side.along(x), kKerbHeight);
      if (kind == 0)
        add_hedge(mesh_, pose, 3.1, random);
      else if (kind == 1)
        add_box(mesh_, pose * Eigen::Translation3d(0.0, 0.0, -0.4), {3.1, 0.25, 0.4 + height},
                kPlaster);
      else
        add_railing(pose, 3.1);
    }
  }

  // Trees, bushes and sheds in all gardens that lie within sight of a street.
  void add_gardens(const std::vector<Street>& streets, Random random) {
    const Vector2d low = lanes_.corner(0, 0);
    const Vector2d high = lanes_.corner(lanes_.columns() - 1, lanes_.rows() - 1);
    const LaneMap sight(lanes_of(streets), low, high, 8.0, kSight);
    for (double gx = low.x() + kGarden; gx < high.x() - kGarden; gx += kGarden) {
      for (double gy = low.y() + kGarden; gy < high.y() - kGarden; gy += kGarden) {
        const Vector2d shift{random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0)};
        const double kind = random.uniform(), yaw = random.uniform(0.0, std::numbers::pi);
        const Vector2d place = Vector2d(gx, gy) + shift;
        const Vector2d along(std::cos(yaw), std::sin(yaw));
        if (sight.distance(place) >= kSight) continue;
        if (kind < 0.5 && taken_.take({place, along, 1.5, 1.5}, kFenceLine + 0.8))
          add_tree(mesh_, upright(place, along, kKerbHeight), random);
        else if (kind < 0.6 && taken_.take({place, along, 4.0, 3.0}, kFenceLine + 1.0))
          add_box(mesh_, upright(place, along, -0.3), {4.0, 3.0, 2.9}, kPlaster);
        else if (kind < 0.8 && taken_.take({place, along, 4.0, 0.7}, kFenceLine + 1.0))
          add_hedge(mesh_, on_slope(place, along, kKerbHeight), 4.0, random);
      }
    }
  }

 private:
  void add_railing(const Pose& pose, double length) {
    for (double x = 0.1; x < length; x += 0.35)
      add_box(mesh_, pose * Eigen::Translation3d(x - 0.5 * length, 0.0, -0.1), {0.05, 0.05, 1.2},
              kSteel);
    add_box(mesh_, pose * Eigen::Translation3d(0.0, 0.0, 1.0), {length, 0.04, 0.05}, kSteel);
  }

  Pose upright(const Vector2d& place, const Vector2d& x, double raised) const {
    return Eigen::Translation3d(place.x(), place.y(), terrain_.height(place) + raised) *
           Eigen::AngleAxisd(std::atan2(x.y(), x.x()), Vector3d::UnitZ());
  }

  Pose on_slope(const Vector2d& place, const Vector2d& x, double raised) const {
    return stand_on(terrain_, place, std::atan2(x.y(), x.x())) *
           Eigen::Translation3d(0.0, 0.0, raised);
  }

  // A house stands on the lowest corner of its plot; its front is what `away` leads away from.
  Pose on_level(const Footprint& f, const Vector2d& away) const {
    double lowest = terrain_.height(f.middle);
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        lowest = std::min(lowest,
                          terrain_.height(f.middle + x * f.length * f.along + y * f.width * away));
    const Vector2d front = f.middle - 0.5 * f.width * away;
    return Eigen::Translation3d(front.x(), front.y(), lowest + kKerbHeight) *
           Eigen::AngleAxisd(std::atan2(-away.x(), away.y()), Vector3d::UnitZ());
  }

  Mesh& mesh_;
  const Terrain& terrain_;
  Occupancy taken_;
  const LaneMap& lanes_;
};

}  // namespace

void add_city_lots(Mesh& mesh, const std::vector<Street>& streets, const LaneMap& lanes,
                   const Terrain& terrain, std::uint64_t seed) {
  LotBuilder lots(mesh, lanes, terrain);
  std::vector<Side> sides;
  for (const Street& street : streets)
    for (Side& side : sides_of(street)) sides.push_back(std::move(side));
  for (std::size_t i = 0; i < sides.size(); ++i) {
    lots.add_parked_cars(sides[i], Random(hash(seed, i, 1)));
    lots.add_verge(sides[i], Random(hash(seed, i, 2)));
    lots.add_houses(sides[i], 0.0, 0.9, Random(hash(seed, i, 3)));
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    lots.add_fences(sides[i], Random(hash(seed, i, 4)));
    lots.add_houses(sides[i], kBackRow, 0.6, Random(hash(seed, i, 5)));
  }
  lots.add_gardens(streets, Random(hash(seed, sides.size())));
}

}  // namespace lego_loam_sc
