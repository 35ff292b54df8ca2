// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/time.hpp"
#include "sim/geometry.hpp"

namespace lego_loam_sc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNodeSpacing = 0.25;  // m between the nodes of the speed profile
constexpr double kRamp = 2.0;          // s in which the shaking grows and dies away

double node_distance(const Route& route, std::size_t node, std::size_t nodes) {
  return route.length() * static_cast<double>(node) / static_cast<double>(nodes - 1);
}

// As fast as the bends and the acceleration allow, at rest at both ends.
std::vector<double> speed_profile(const Route& route, const DriveSettings& settings) {
  const auto nodes = static_cast<std::size_t>(std::ceil(route.length() / kNodeSpacing)) + 1;
  const double gain = 2.0 * settings.acceleration * node_distance(route, 1, nodes);
  std::vector<double> squared(nodes, 0.0);
  for (std::size_t i = 1; i + 1 < nodes; ++i) {
    const double curvature = std::abs(route.at(node_distance(route, i, nodes)).curvature);
    squared[i] = std::min({settings.speed * settings.speed,
                           settings.lateral_acceleration / std::max(curvature, 1e-9),
                           squared[i - 1] + gain});
  }
  for (std::size_t i = nodes - 1; i-- > 0;)
    squared[i] = std::min(squared[i], squared[i + 1] + gain);
  for (double& value : squared) value = std::sqrt(value);
  return squared;
}

// The vehicle stands on its four wheels.
Pose pose_on_ground(const Ground& ground, const Route::Point& point, double wheel_base,
                    double track_width) {
  const Vector2d along = 0.5 * wheel_base * point.direction;
  const Vector2d left = 0.5 * track_width * left_of(point.direction);
  const auto height = [&](const Vector2d& offset) {
    const Vector2d wheel = point.position + offset;
    return ground(wheel.x(), wheel.y());
  };
  const double front_left = height(along + left), front_right = height(along - left);
  const double rear_left = height(left - along), rear_right = height(-along - left);
  const double rise = 0.5 * (front_left + front_right - rear_left - rear_right);
  const double bank = 0.5 * (front_left + rear_left - front_right - rear_right);
  Pose pose = Pose::Identity();
  pose.linear() = rotation_from_rpy(std::atan(bank / track_width), -std::atan(rise / wheel_base),
                                    std::atan2(point.direction.y(), point.direction.x()));
  pose.translation() = Vector3d(point.position.x(), point.position.y(),
                                0.25 * (front_left + front_right + rear_left + rear_right));
  return pose;
}

}  // namespace

Drive::Drive(Route route, Ground ground, const DriveSettings& settings)
    : Drive(std::move(route), std::vector<GroundSection>{{0.0, std::move(ground)}}, settings) {}

Drive::Drive(Route route, std::vector<GroundSection> sections, const DriveSettings& settings)
    : route_(std::move(route)),
      sections_(std::move(sections)),
      wheel_base_(settings.wheel_base),
      track_width_(settings.track_width),
      speeds_(speed_profile(route_, settings)),
      shaking_(settings.shaking, settings.seed) {
  const double step = node_distance(route_, 1, speeds_.size());
  times_.push_back(0.0);
  for (std::size_t i = 1; i < speeds_.size(); ++i)
    times_.push_back(times_.back() + 2.0 * step / (speeds_[i - 1] + speeds_[i]));
}

std::int64_t Drive::duration_ns() const {
  return static_cast<std::int64_t>(std::ceil(times_.back() * 1e9));
}

Pose Drive::pose(std::int64_t time_ns) const {
  const double time = std::clamp(seconds(time_ns), 0.0, times_.back());
  const double distance = distance_at(time);
  return pose_on_ground(ground_at(distance), route_.at(distance), wheel_base_, track_width_) *
         shaking_at(time);
}

const Ground& Drive::ground_at(double distance) const {
  const auto next = std::ranges::upper_bound(sections_, distance, {}, &GroundSection::start);
  return std::prev(next)->ground;
}

// Between two nodes the acceleration is constant.
double Drive::distance_at(double time) const {
  const auto after = std::upper_bound(times_.begin(), times_.end() - 1, time);
  const auto i = static_cast<std::size_t>(after - times_.begin()) - 1;
  const double step = node_distance(route_, 1, speeds_.size());
  const double acceleration =
      (speeds_[i + 1] * speeds_[i + 1] - speeds_[i] * speeds_[i]) / (2.0 * step);
  const double since = time - times_[i];
  const double distance =
      static_cast<double>(i) * step + (speeds_[i] + 0.5 * acceleration * since) * since;
  return std::min(distance, route_.length());
}

Pose Drive::shaking_at(double time) const {
  const double strength = smooth_step(time / kRamp) * smooth_step((times_.back() - time) / kRamp);
  return shaking_.at(time, strength);
}

Motion motion_of(Drive drive) {
  const std::int64_t duration_ns = drive.duration_ns();
  return {[drive = std::move(drive)](std::int64_t time_ns) { return drive.pose(time_ns); },
          duration_ns};
}

}  // namespace lego_loam_sc
