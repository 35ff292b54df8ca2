// SPDX-License-Identifier: BSD-3-Clause
#include "sim/city_traffic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "core/time.hpp"
#include "sim/city_streets.hpp"
#include "sim/geometry.hpp"
#include "sim/materials.hpp"
#include "sim/props.hpp"
#include "sim/random.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kCars = 4;  // models of cars, then those of a cyclist and a walker
constexpr std::size_t kCyclist = kCars, kWalker = kCars + 1;
constexpr double kBeyond = 70.0;    // m; the street goes on so far before and after the path
constexpr double kPavement = 4.75;  // m from the lane to the walkers
constexpr double kCloth = 0.3;      // reflectivity

Mesh make_walker() {
  Mesh mesh;
  const auto at = [](double y, double z) -> Pose { return Pose(Eigen::Translation3d(0.0, y, z)); };
  for (const double y : {-0.11, 0.11})
    add_cylinder(mesh, at(y, -kKerbHeight), 0.09, 0.9 + kKerbHeight, kCloth);
  add_box(mesh, at(0.0, 0.85), {0.26, 0.48, 0.6}, kCloth);
  add_cylinder(mesh, at(0.0, 1.48), 0.1, 0.26, kCloth);
  return mesh;
}

Mesh make_cyclist() {
  Mesh mesh;
  const auto at = [](double x, double z) -> Pose { return Pose(Eigen::Translation3d(x, 0.0, z)); };
  for (const double x : {-0.52, 0.52}) add_box(mesh, at(x, 0.0), {0.66, 0.05, 0.66}, kSteel);
  add_box(mesh, at(0.0, 0.5), {0.9, 0.06, 0.08}, kSteel);
  add_box(mesh, at(0.5, 0.95), {0.05, 0.55, 0.05}, kSteel);
  add_box(mesh, at(-0.1, 0.4), {0.2, 0.32, 0.6}, kCloth);  // legs
  add_box(mesh, at(0.05, 0.95), {0.3, 0.44, 0.55}, kCloth);
  add_cylinder(mesh, at(0.15, 1.5), 0.11, 0.25, kCloth);
  return mesh;
}

std::vector<Mesh> make_models(Random random) {
  std::vector<Mesh> models(kCars);
  for (Mesh& model : models) add_car(model, Pose::Identity(), random);
  models.push_back(make_cyclist());
  models.push_back(make_walker());
  return models;
}

// The path of the vehicle and the ground, shared by all movers.
struct Stage {
  TrackPath path;
  Terrain terrain;

  double end() const { return path.travelled.end(); }

  // A place `left` (m) of the path at `distance` (m), heading along it or, `back`, against it.
  Pose place(double distance, double left, bool back) const {
    const Vector2d along = path.curve.derivative(distance).normalized();
    const Vector2d place = path.curve.at(distance) + left * left_of(along);
    const Vector2d heading = back ? Vector2d(-along) : along;
    return stand_on(terrain, place, std::atan2(heading.y(), heading.x()));
  }
  Pose vehicle(double time) const { return place(path.travelled.at(time), 0.0, false); }
};

// Three circles cover a car with some room, so two cars are apart when all their circles are.
bool apart(const Pose& a, const Pose& b) {
  constexpr double kRadius = 1.15;
  if ((a.translation() - b.translation()).norm() > 8.0) return true;
  for (const double x : {-1.6, 0.0, 1.6})
    for (const double y : {-1.6, 0.0, 1.6})
      if ((a * Vector3d(x, 0, 0) - b * Vector3d(y, 0, 0)).norm() < 2.0 * kRadius) return false;
  return true;
}

class TrafficMaker {
 public:
  TrafficMaker(std::shared_ptr<const Stage> stage, const LaneMap& lanes, TrafficPlan& plan)
      : stage_(std::move(stage)), lanes_(lanes), plan_(plan) {}

  // A car that is caught up with at one part of the path, leads at a second's distance and leaves.
  void add_leader(std::size_t model, double from_part, double to_part) {
    constexpr double kFar = 90.0, kApproach = 300.0;  // m
    const double length = stage_->path.curve.end();
    const double from = from_part * length, to = to_part * length;
    const auto distance = [stage = stage_, from, to](double time) {
      const double own = stage->path.travelled.at(time);
      return stage->path.travelled.at(time + 1.0) + 8.0 +
             kFar * (1.0 - smooth_step((own - from) / kApproach) +
                     smooth_step((own - to + kApproach) / kApproach));
    };
    add_if_apart({model, nanoseconds(time_at(from)), nanoseconds(time_at(to)),
                  [stage = stage_, distance](std::int64_t time_ns) {
                    return stage->place(distance(seconds(time_ns)), 0.0, false);
                  }});
  }

  // Comes towards the vehicle and meets it at `time` (s).
  void add_oncoming(std::size_t model, double time, double speed) {
    const double meeting = stage_->path.travelled.at(time);
    const double from =
        std::max(time - 12.0, time - (stage_->path.curve.end() + kBeyond - meeting) / speed);
    const double to = std::min(time + 12.0, time + (meeting + kBeyond) / speed);
    add_if_apart({model, nanoseconds(from), nanoseconds(to),
                  [stage = stage_, meeting, time, speed](std::int64_t time_ns) {
                    return stage->place(meeting + speed * (time - seconds(time_ns)), kLaneOffset,
                                        true);
                  }});
  }

  // Walks on the pavement on either side, along or against the path.
  void add_walker(double time, double speed, bool on_left) {
    const double meeting = stage_->path.travelled.at(time);
    const double left = on_left ? kLaneOffset + kPavement : -kPavement;
    const Mover walker{kWalker, nanoseconds(time - 12.0), nanoseconds(time + 12.0),
                       [stage = stage_, meeting, time, speed, left](std::int64_t time_ns) -> Pose {
                         const double since = seconds(time_ns) - time;
                         return stage->place(meeting + speed * since, left, speed < 0.0) *
                                Eigen::Translation3d(0.0, 0.0, kKerbHeight);
                       }};
    for (std::int64_t t = walker.from_ns; t < walker.to_ns; t += 200'000'000) {
      const double from_lane = lanes_.distance(walker.pose(t).translation().head<2>());
      if (from_lane < kVerge + 0.5 || from_lane > kFenceLine - 0.4) return;
    }
    add_if_apart(walker);
  }

 private:
  // When the vehicle has travelled so far, s.
  double time_at(double distance) const {
    double time = 0.0;
    while (time < stage_->end() && stage_->path.travelled.at(time) < distance) time += 0.1;
    return time;
  }

  void add_if_apart(Mover mover) {
    for (std::int64_t t = mover.from_ns; t <= mover.to_ns; t += 50'000'000) {
      const Pose pose = mover.pose(t);
      if (!apart(pose, stage_->vehicle(seconds(t)))) return;
      for (const Mover& other : plan_.movers)
        if (t >= other.from_ns && t <= other.to_ns && !apart(pose, other.pose(t))) return;
    }
    plan_.movers.push_back(std::move(mover));
  }

  std::shared_ptr<const Stage> stage_;
  const LaneMap& lanes_;
  TrafficPlan& plan_;
};

}  // namespace

TrafficPlan make_city_traffic(const TrackPath& path, const Terrain& terrain, const LaneMap& lanes,
                              std::uint64_t seed) {
  TrafficPlan plan{.models = make_models(Random(hash(seed, 1))), .movers = {}};
  const auto stage = std::make_shared<const Stage>(Stage{path, terrain});
  TrafficMaker maker(stage, lanes, plan);
  maker.add_leader(0, 0.10, 0.45);
  maker.add_leader(1, 0.60, 0.85);
  Random random(hash(seed, 2));
  for (double t = random.uniform(2.0, 8.0); t < stage->end(); t += random.uniform(5.0, 15.0)) {
    const bool cyclist = random.chance(0.2);
    const auto car = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(kCars)));
    const double speed = random.uniform(10.0, 14.0);
    maker.add_oncoming(cyclist ? kCyclist : car, t, cyclist ? 0.4 * speed : speed);
  }
  for (double t = random.uniform(2.0, 8.0); t < stage->end(); t += random.uniform(4.0, 12.0)) {
    const double speed = random.uniform(1.1, 1.6) * (random.chance(0.5) ? 1.0 : -1.0);
    maker.add_walker(t, speed, random.chance(0.5));
  }
  return plan;
}

}  // namespace lego_loam_sc
