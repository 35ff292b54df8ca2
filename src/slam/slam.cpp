// SPDX-License-Identifier: BSD-3-Clause
#include "slam/slam.hpp"

#include <stdexcept>
#include <utility>

#include "slam/slam_state.hpp"

namespace lego_loam_sc {
namespace {

// Times that the first two scans are processed anew when the drive begins at speed.
constexpr int kBeginnings = 2;

const Settings& checked(const SensorModel& sensor, const Settings& settings) {
  if (const auto fault = validate(sensor)) throw std::invalid_argument(*fault);
  if (const auto fault = validate(settings)) throw std::invalid_argument(*fault);
  return settings;
}

}  // namespace

Slam::Slam(const SensorModel& sensor, const Settings& settings, int threads, LoopDetector detector,
           std::shared_ptr<BlobStore> points)
    : state_(std::make_unique<State>(sensor, checked(sensor, settings), threads,
                                     std::move(detector), std::move(points))) {}
Slam::~Slam() = default;
Slam::Slam(Slam&&) noexcept = default;
Slam& Slam::operator=(Slam&&) noexcept = default;

ScanReport Slam::process(const Scan& scan) {
  ScanReport report = state_->arena.execute([&] { return state_->process(scan); });
  if (state_->live.size() == 1 && !state_->first_scan) {
    state_->first_scan = scan;
  } else if (state_->first_scan && report.status != Status::out_of_order) {
    const Scan first = std::move(*state_->first_scan);
    state_->first_scan.reset();
    report = begin_again(first, scan, report);
  }
  return report;
}

// A drive may begin at speed, but only the second scan tells the motion that the first sweep is to
// be de-skewed with. So both are processed anew, knowing it, until it is right. What is motion
// compensated needs no such knowledge.
ScanReport Slam::begin_again(const Scan& first, const Scan& second, ScanReport report) {
  if (state_->sensor.motion_compensated) return report;
  Vector6 known = Vector6::Zero();
  for (int k = 0; k < kBeginnings; ++k) {
    const Vector6 motion = state_->twist * state_->sensor.period;
    if (report.status > Status::odometry_only ||
        (motion - known).head<3>().norm() < state_->sensor.range_noise)
      break;
    known = motion;
    auto again = std::make_unique<State>(state_->given_sensor, state_->settings,
                                         state_->arena.max_concurrency(), state_->detector,
                                         state_->point_store);
    again->twist = state_->twist;
    again->speed = state_->twist.head<3>().norm();
    again->arena.execute([&] {
      again->process(first);
      report = again->process(second);
    });
    state_ = std::move(again);
  }
  return report;
}

bool Slam::write(StateWriter& writer) const {
  if (state_->first_scan) return false;
  writer(*state_);
  return true;
}

void Slam::read(StateReader& reader) {
  state_->arena.execute([&] { reader(*state_); });
}

const Trajectory& Slam::odometry() const {
  return state_->live;
}
Trajectory Slam::trajectory() const {
  return state_->fusion.fuse(state_->graph.poses());
}
const KeyFrames& Slam::key_frames() const {
  return state_->key_frames;
}
const PoseGraph& Slam::graph() const {
  return state_->graph;
}
int Slam::maps() const {
  return state_->pieces.maps();
}
double Slam::sensor_height() const {
  return state_->height;
}
Eigen::Matrix3d Slam::R_level_lidar() const {
  return R_base_lidar(state_->sensor);
}

}  // namespace lego_loam_sc
