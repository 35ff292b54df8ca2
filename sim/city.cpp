// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "core/time.hpp"
#include "sim/city_ground.hpp"
#include "sim/city_lots.hpp"
#include "sim/city_route.hpp"
#include "sim/city_streets.hpp"
#include "sim/city_traffic.hpp"
#include "sim/places.hpp"
#include "sim/random.hpp"
#include "sim/recorded_track.hpp"
#include "sim/shaking.hpp"
#include "sim/terrain.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSensorHeight = 1.73;  // m
constexpr double kMargin = 130.0;       // m of city round the route
constexpr double kMapCell = 1.0;        // m
constexpr double kMapReach = 16.0;      // m; nothing is placed by a larger distance from the lanes

// Points on the ground below the sensor, some 4 m apart.
std::vector<Vector3d> ground_points(const Track& track) {
  std::vector<Vector3d> points;
  for (double t = 0.0; t <= track.plan.end(); t += 0.1) {
    const Vector2d place = track.plan.at(t).head<2>();
    if (points.empty() || (place - points.back().head<2>()).norm() >= 4.0)
      points.emplace_back(place.x(), place.y(), track.height.at(t) - kSensorHeight);
  }
  return points;
}

}  // namespace

World make_city(std::uint64_t seed, const Trajectory& route) {
  const Track track = make_track(route);
  const std::vector<Vector3d> ground = ground_points(track);
  Vector2d low = ground.front().head<2>(), high = low;
  for (const Vector3d& point : ground) {
    low = low.cwiseMin(point.head<2>());
    high = high.cwiseMax(point.head<2>());
  }
  low.array() -= kMargin;
  high.array() += kMargin;
  const Terrain terrain = Terrain::along(ground, low, high);
  const TrackPath path = path_of(track);
  const std::vector<Street> streets = make_streets(path.curve, hash(seed, 1));
  const LaneMap lanes(lanes_of(streets), low, high, kMapCell, kMapReach);

  World world{.sensor = "hdl64e", .sensor_height = kSensorHeight, .mesh = {}, .motion = {}};
  add_city_ground(world.mesh, lanes, terrain);
  add_city_lots(world.mesh, streets, lanes, terrain, hash(seed, 2));
  const Shaking shaking{.roll_deg = 0.1, .pitch_deg = 0.12, .yaw_deg = 0.03, .z = 0.008};
  world.motion.pose = [track, terrain,
                       shake = ShakingMotion(shaking, hash(seed, 3))](std::int64_t time_ns) {
    const double time = seconds(time_ns);
    const Vector3d plan = track.plan.at(time);
    return stand_on(terrain, plan.head<2>(), plan.z()) * shake.at(time);
  };
  world.motion.duration_ns = nanoseconds(track.plan.end());
  world.traffic = make_city_traffic(path, terrain, lanes, hash(seed, 4));
  world.range_noise = 0.025;
  world.worn_sensor = true;
  return world;
}

World make_kitti00(std::uint64_t seed) {
  return make_city(seed, make_city_route());
}

}  // namespace lego_loam_sc
