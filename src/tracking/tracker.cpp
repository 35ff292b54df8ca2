// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracker.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/time.hpp"
#include "key_frames/make_key_frame.hpp"
#include "registration/deskew.hpp"
#include "tracking/stage_timer.hpp"
#include "tracking/stamp_pose.hpp"

namespace lego_loam_sc {
namespace {

// Maximum number of times the first two scans are reprocessed.
constexpr int kMaxReprocessings = 2;
// Two scans with sweeps of different length may have reference times out of order, s.
constexpr double kShortestStep = 1e-3;

// FNV-1a over the bytes, eight at a time.
std::uint64_t hash_of(const std::vector<Eigen::Vector3f>& points) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto* bytes = reinterpret_cast<const unsigned char*>(points.data());
  const std::size_t size = points.size() * sizeof(Eigen::Vector3f);
  for (std::size_t at = 0; at < size; at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + at, std::min(sizeof word, size - at));
    hash = (hash ^ word) * 0x100000001b3;
  }
  return hash;
}

}  // namespace

Tracker::Tracker(const SensorModel& sensor, const TrackerSettings& settings,
                 std::shared_ptr<const KeyFrames> key_frames)
    : settings_(settings),
      key_frames_(std::move(key_frames)),
      calibration_(sensor),
      clock_(sensor.period),
      check_(sensor),
      odometry_(settings.odometry, sensor.range_noise),
      mapper_(settings.mapping, sensor.range_noise, row_spacing(sensor)),
      map_updater_(settings.mapping.radius),
      monitor_(settings.tracking),
      witness_(row_spacing(sensor)) {}

TrackedScan Tracker::track(const Scan& scan) {
  const bool first = progress_.last_key_frame.number < 0;
  const std::uint64_t hash = hash_of(scan.points);
  if (!first && !scan.points.empty() && hash == progress_.last_scan.points_hash)
    return repeat(scan);
  TrackedScan tracked = track_once(scan, progress_.scans++);
  if (is_placed(tracked.status)) progress_.last_scan.points_hash = hash;
  if (tracked.status == Status::out_of_order) return tracked;
  if (first) {
    first_scan_ = FirstScan{tracked.index, scan};
  } else if (first_scan_) {
    const FirstScan first_scan = std::move(*first_scan_);
    first_scan_.reset();
    return reprocess_first_scans(first_scan, scan, std::move(tracked));
  }
  return tracked;
}

// A drive may begin at speed, but only the second scan shows the motion that the first sweep is to
// be de-skewed with. So both are tracked anew, knowing it, until it no longer changes. Scans that
// are motion compensated do not need it. What the two scans together have shown of the input, as
// the body of the vehicle, is new to the first one too.
TrackedScan Tracker::reprocess_first_scans(const FirstScan& first, const Scan& second,
                                           TrackedScan tracked) {
  const int index = tracked.index;
  // A tilt counts only when both show it.
  if (calibration_.tilt_is_estimated() && !calibration_.shows_tilt(second)) {
    find_tilt_ = false;
    tracked = restart(first, second, index, Vector6::Zero());
  }
  const SensorModel& sensor = calibration_.nominal;
  if (check_.has_learnt()) tracked = restart(first, second, index, Vector6::Zero());
  if (sensor.motion_compensated) return tracked;
  Vector6 known = Vector6::Zero();
  for (int k = 0; k < kMaxReprocessings; ++k) {
    const Vector6 twist = motion_.twist;
    const Vector6 motion = twist * sensor.period;
    if (!is_placed(tracked.status) || (motion - known).head<3>().norm() < sensor.range_noise) break;
    known = motion;
    tracked = restart(first, second, index, twist);
  }
  return tracked;
}

// A driver repeats its last scan when the sensor stops or a playback pauses. How the sensor moves
// meanwhile is unknown; that the scan would fit best where it was says nothing.
TrackedScan Tracker::repeat(const Scan& scan) {
  TrackedScan tracked;
  tracked.index = progress_.scans++;
  tracked.stamp_ns = scan.stamp_ns;
  const std::optional<ScanTime> time = clock_.read(scan.stamp_ns);
  tracked.status = time ? Status::repeated : Status::out_of_order;
  if (time) tracked.stamp_jump_s = time->jump_s;
  tracked.T_odom_lidar = progress_.last_scan.T_odom_lidar;
  tracked.last_key_frame = progress_.last_key_frame.number;
  tracked.T_key_lidar = progress_.last_scan.T_key_lidar;
  tracked.fragment = progress_.fragment;
  return tracked;
}

// Tracks the first two scans as if there had been none, knowing their motion.
TrackedScan Tracker::restart(const FirstScan& first, const Scan& second, int index,
                             const Vector6& twist) {
  const bool find_tilt = find_tilt_;
  const std::uint64_t hash = progress_.last_scan.points_hash;
  ScanCheck check = std::move(check_);
  check.restart();
  *this = Tracker(calibration_.nominal, settings_, key_frames_);
  find_tilt_ = find_tilt;
  progress_.last_scan.points_hash = hash;
  check_ = std::move(check);
  motion_.twist = twist;
  motion_.speed = twist.head<3>().norm();
  motion_.known = !twist.isZero();
  auto first_again = std::make_shared<TrackedScan>(track_once(first.scan, first.index));
  TrackedScan tracked = track_once(second, index);
  tracked.first_again = std::move(first_again);
  progress_.scans = index + 1;
  return tracked;
}

TrackedScan Tracker::track_once(const Scan& scan, int index) {
  TrackedScan tracked;
  tracked.index = index;
  tracked.stamp_ns = scan.stamp_ns;
  tracked.T_odom_lidar = calibration_.to_lidar_frame(motion_.previous.T_odom_lidar);
  const std::optional<ScanTime> time = clock_.read(scan.stamp_ns);
  if (!time) {
    tracked.status = Status::out_of_order;
    return tracked;
  }

  const FrontEnd front_end = look_at(scan, time->time_ns);  // 2.3 (1), (2)
  tracked.milliseconds = front_end.milliseconds;
  StageTimer timer(tracked.milliseconds);
  const Step step = begin_step(front_end, *time);

  timer.start(Stage::odometry);
  const Motion motion = measure_motion(front_end.features, step);  // 2.3 (3)

  timer.start(Stage::mapping);
  const Placement placement = place(front_end.features, motion, step, index);  // 2.3 (4)
  if (placement.new_fragment) begin_fragment();
  const Advance moved = advance(front_end, motion, step, placement);
  // Holds from the next scan on.
  if (settings_.mapping.elevation_bias && placement.placed())
    calibration_.observe_ground(front_end, motion_.travelled);

  timer.start(Stage::loops);
  const Pose& T_map_lidar = moved.current.T_map_lidar;
  if (step.first || placement.new_fragment ||
      (placement.placed() && placement.mapped && is_far_from_last_key_frame(T_map_lidar)))
    tracked.key_frame = begin_key_frame(front_end, moved, placement, index);
  timer.stop();

  tracked.stamp_jump_s = step.jump_s;
  tracked.status = placement.status;
  tracked.counts = counts_of(front_end);
  tracked.motion = motion;
  tracked.mapped = placement.mapped;
  tracked.match = placement.found;
  tracked.elevation_bias_deg = calibration_.elevation_bias_deg();
  tracked.prediction_m = moved.prediction_m;
  tracked.testimony = moved.testimony;
  tracked.T_odom_lidar =
      calibration_.to_lidar_frame(moved.current.T_odom_lidar * moved.T_reference_stamp);
  tracked.last_key_frame = progress_.last_key_frame.number;
  tracked.T_key_lidar = calibration_.to_lidar_frame(progress_.last_key_frame.T_map_key.inverse() *
                                                    T_map_lidar * moved.T_reference_stamp);
  tracked.fragment = progress_.fragment;
  progress_.last_scan.T_odom_lidar = tracked.T_odom_lidar;
  progress_.last_scan.T_key_lidar = tracked.T_key_lidar;
  return tracked;
}

// The first scans also show how the sensor is mounted.
FrontEnd Tracker::look_at(const Scan& scan, std::int64_t time_ns) {
  FrontEnd front_end = run_front_end(scan, calibration_.sensor, calibration_.height, settings_,
                                     find_tilt_ && mapper_.empty(), check_);
  front_end.image.reference_ns += time_ns - scan.stamp_ns;
  calibration_.set_mounting(front_end.mounting);
  return front_end;
}

Tracker::Step Tracker::begin_step(const FrontEnd& front_end, const ScanTime& time) {
  const std::int64_t reference_ns = front_end.image.reference_ns;
  Step step;
  step.first = progress_.last_key_frame.number < 0;
  step.jump_s = time.jump_s;
  step.seconds =
      step.first ? calibration_.sensor.period
                 : std::max(seconds(reference_ns - motion_.previous.reference_ns), kShortestStep);
  step.stamp_age = seconds(time.time_ns - reference_ns);
  step.enough_points = std::ssize(front_end.image.points) >= settings_.tracking.min_points;
  monitor_.note_gap(step.jump_s, step.seconds);
  // The map begins at the first scan's stamp. Motion at the first stamp is known only after
  // reprocessing.
  if (step.first)
    motion_.previous.T_map_lidar = motion_.previous.T_odom_lidar =
        extrapolate(motion_.twist, -(step.seconds + step.stamp_age));
  return step;
}

// LiDAR odometry, 2.3 (3), from the prediction that the last motion goes on.
Motion Tracker::measure_motion(const Features& features, const Step& step) const {
  Motion predicted;
  predicted.T_previous_current = motion_.predicted_motion(step.seconds);
  if (step.first || !step.enough_points) return predicted;
  return odometry_.estimate(features, predicted.T_previous_current, step.seconds);
}

// LiDAR mapping, 2.3 (4): the first good scan makes the map, every n-th of the others is matched
// with it. Where neither map nor odometry tell the place it is predicted.
Tracker::Placement Tracker::place(const Features& features, const Motion& motion, const Step& step,
                                  int index) {
  Placement placement;
  placement.match.T_map_lidar = motion_.previous.T_map_lidar * motion.T_previous_current;
  if (!step.enough_points) {
    placement.status = Status::too_few_points;
  } else if (mapper_.empty()) {
    placement.mapped = true;
    monitor_.clear();
  } else {
    placement.mapped = index % settings_.mapping.every == 0;
    if (placement.mapped) {
      placement.found = placement.match = match_with_map(features, motion, step.seconds);
      if (!placement.match.matched)
        placement.status = Status::odometry_only;
      else if (placement.match.localizability.degenerate())
        placement.status = Status::degenerate;
    }
    if (!monitor_.place_is_known(motion.solved, placement.match)) {
      placement.status = Status::lost;
      placement.match = {};
      placement.match.T_map_lidar =
          motion_.previous.T_map_lidar * motion_.predicted_motion(step.seconds);
    }
  }
  placement.new_fragment = monitor_.should_start_new_map();
  if (placement.new_fragment) placement.mapped = true;
  return placement;
}

// From the odometry's motion or, when that does not hold, from the prediction.
MapMatch Tracker::match_with_map(const Features& features, const Motion& motion, double seconds) {
  const Pose T_map_predicted = motion_.T_map_predicted(seconds);
  const auto refine_from = [&](const Pose& T_previous_current, bool measured) {
    return mapper_.refine(features, {motion_.previous.T_map_lidar * T_previous_current,
                                     T_map_predicted, T_previous_current, seconds, measured});
  };
  if (!motion_.known)
    return mapper_.search(features,
                          {motion_.previous.T_map_lidar * motion.T_previous_current,
                           T_map_predicted, motion.T_previous_current, seconds, motion.solved},
                          motion_.previous.T_map_lidar);
  MapMatch match = refine_from(motion.T_previous_current, motion.solved);
  if (match.matched || !motion.solved) return match;
  MapMatch again = refine_from(motion_.predicted_motion(seconds), false);
  return again.matched ? again : match;
}

// The map does not hold where the sensor is now: another one begins, from the prediction.
void Tracker::begin_fragment() {
  mapper_.clear();
  map_updater_.clear();
  monitor_.clear();
  witness_.clear();
  ++progress_.fragment;
}

// Takes the scan's place for its motion, and its features for the next scan and the map. A scan
// without a place changes nothing. Odometry takes the same motion, uncorrected by loops.
Tracker::Advance Tracker::advance(const FrontEnd& front_end, const Motion& motion, const Step& step,
                                  const Placement& placement) {
  const ScanState previous = motion_.previous;
  const MapMatch& match = placement.match;
  const Pose T_previous_current = previous.T_map_lidar.inverse() * match.T_map_lidar;
  Advance result;
  if (!step.first)
    result.prediction_m =
        (T_previous_current.translation() - motion_.predicted_motion(step.seconds).translation())
            .norm();
  result.current = {front_end.image.reference_ns, match.T_map_lidar,
                    normalized(previous.T_odom_lidar * T_previous_current), motion_.twist};
  result.T_reference_stamp = extrapolate(motion_.twist, step.stamp_age);
  if (!placement.placed()) return result;

  if (!step.first && !placement.new_fragment && step.jump_s == 0.0)
    motion_.twist =
        log_se3(settings_.mapping.every == 1 ? T_previous_current : motion.T_previous_current) /
        step.seconds;
  motion_.add_displacement(T_previous_current.translation().norm(), step.seconds,
                           match.localizability.degenerate_translations == 0);
  if (!step.first) motion_.known = !placement.new_fragment;
  const Vector6& twist = result.current.twist = match.matched ? match.twist : motion_.twist;
  result.T_reference_stamp =
      step.first || placement.new_fragment
          ? extrapolate(twist, step.stamp_age)
          : interpolate(T_previous_current, previous.twist, twist, step.seconds, step.stamp_age);
  motion_.previous = result.current;

  result.testimony = hear_witnesses(front_end.image, result.current);
  result.features = deskew(front_end.features, twist);
  odometry_.set_previous(result.features);
  if (placement.mapped) mapper_.add_scan(result.features, result.current.T_map_lidar);
  map_updater_.insert_pending(*key_frames_, mapper_);
  return result;
}

Testimony Tracker::hear_witnesses(const RangeImage& image, const ScanState& state) const {
  std::vector<FeaturePoint> chosen;
  for (const std::size_t i : witnesses(image.size())) {
    FeaturePoint& point = chosen.emplace_back();
    point.position = image.points[i];
    point.time = image.time[i];
  }
  std::vector<Eigen::Vector3f> points;
  for (const FeaturePoint& point : deskew(chosen, state.twist)) points.push_back(point.position);
  return witness_.hear(points, state.T_map_lidar);
}

bool Tracker::is_far_from_last_key_frame(const Pose& T_map_lidar) const {
  const Pose since = progress_.last_key_frame.T_map_key.inverse() * T_map_lidar;
  return since.translation().norm() >= settings_.key_frames.distance ||
         rotation_angle(since) >= radians(settings_.key_frames.rotation_deg);
}

TrackedKeyFrame Tracker::begin_key_frame(const FrontEnd& front_end, const Advance& moved,
                                         const Placement& placement, int index) {
  TrackedKeyFrame result;
  result.number = progress_.last_key_frame.number + 1;
  result.scan = index;
  result.points = deskewed_points(front_end.image, moved.current.twist);
  result.key_frame =
      make_key_frame(front_end.image, front_end.segmentation, moved.features, result.points,
                     motion_.travelled, settings_.key_frames.point_spacing);
  result.sensor_height = calibration_.height;
  result.T_map_key = placement.match.T_map_lidar;
  result.T_last_key = progress_.last_key_frame.T_map_key.inverse() * result.T_map_key;
  result.covariance = placement.match.covariance;
  result.localizability = placement.match.localizability;
  result.starts_fragment = placement.new_fragment;
  progress_.last_key_frame = {result.number, result.T_map_key};
  map_updater_.add(result.number, result.T_map_key);
  witness_.add(result.number, result.points, result.T_map_key);
  return result;
}

void Tracker::correct(const Correction& correction) {
  if (!map_updater_.on_graph_update(correction, *key_frames_, mapper_)) return;
  motion_.previous.T_map_lidar = progress_.last_key_frame.T_map_key = correction.T_map_key.back();
  witness_.correct(correction.T_map_key);
}

}  // namespace lego_loam_sc
