// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/time.hpp"
#include "graph/edge_covariance.hpp"
#include "key_frames/make_key_frame.hpp"
#include "registration/deskew.hpp"
#include "slam/slam_state.hpp"
#include "tracking/front_end.hpp"
#include "tracking/stage_timer.hpp"
#include "tracking/stamp_pose.hpp"

namespace lego_loam_sc {
namespace {

// Scans with fewer points than this are not worth matching.
constexpr std::size_t kMinPoints = 100;
// Seconds over which the speed is averaged.
constexpr double kSpeedMemory = 1.0;

double seconds_between(std::int64_t from_ns, std::int64_t to_ns) {
  return seconds(to_ns - from_ns);
}

}  // namespace

// Paper figure 4.
ScanReport Slam::State::process(const Scan& scan) {
  ScanReport report;
  report.index = scans++;
  report.stamp_ns = scan.stamp_ns;
  report.T_odom_lidar = of_lidar(previous.T_odom_lidar);
  const bool first = live.empty();
  const std::optional<ScanTime> time = clock.read(scan.stamp_ns);
  if (!time) {
    report.status = Status::out_of_order;
    return report;
  }
  report.stamp_jump_s = time->jump_s;

  auto [image, segmentation, features, milliseconds] =
      run_front_end(scan, sensor, height, settings, mapper.empty());
  image.reference_ns += time->time_ns - scan.stamp_ns;
  report.milliseconds = milliseconds;
  report.points = image.size();
  report.ground_points = segmentation.ground_points;
  report.segment_points = segmentation.segment_points;
  report.clusters = segmentation.clusters;
  report.edges_sharp = features.edges_sharp.size();
  report.planars_flat = features.planars_flat.size();
  report.edges_large = features.edges_large.size();
  report.planars_large = features.planars_large.size();
  if (report.points < kMinPoints) report.status = Status::too_few_points;

  // Two scans with sweeps of different length may have reference times out of order.
  const double seconds =
      first ? sensor.period
            : std::max(seconds_between(previous.reference_ns, image.reference_ns), 1e-3);

  doubt.note_gap(time->jump_s, seconds);

  // The map begins at the first scan's stamp; how it moved by then is only known when it is done
  // again.
  const double stamp_age = seconds_between(image.reference_ns, time->time_ns);
  if (first)
    previous.T_map_lidar = previous.T_odom_lidar = extrapolate(twist, -(seconds + stamp_age));

  StageTimer timer(report.milliseconds);
  timer.start(Stage::odometry);
  const Motion motion = predict_and_match(features, seconds, report);

  timer.start(Stage::mapping);
  const MapMatch match = refine(features, motion, seconds, report);
  const bool placed = report.status <= Status::odometry_only;
  const bool new_piece = doubt.should_start_new_map();
  if (new_piece) begin_piece(report);
  const bool good = placed || new_piece;

  // The same motion carries the live pose on, which no loop ever moves.
  const Pose T_previous_current = previous.T_map_lidar.inverse() * match.T_map_lidar;
  if (!first)
    report.prediction_m =
        (T_previous_current.translation() - exp_se3(twist * seconds).translation()).norm();
  Placed current{image.reference_ns, match.T_map_lidar,
                 normalized(previous.T_odom_lidar * T_previous_current), twist};
  Pose T_reference_stamp = extrapolate(twist, stamp_age);
  Features features_deskewed;
  if (good) {
    if (!first && !new_piece && time->jump_s == 0.0)
      twist =
          log_se3(settings.mapping.every == 1 ? T_previous_current : motion.T_previous_current) /
          seconds;
    const double moved = T_previous_current.translation().norm();
    travelled += moved;
    if (match.localizability.degenerate_translations == 0)
      speed += (1.0 - std::exp(-seconds / kSpeedMemory)) * (moved / seconds - speed);
    current.twist = match.matched ? match.twist : twist;
    T_reference_stamp = first || new_piece ? extrapolate(current.twist, stamp_age)
                                           : interpolate(T_previous_current, previous.twist,
                                                         current.twist, seconds, stamp_age);
    previous = current;
    features_deskewed = deskew(features, current.twist);
    odometry.set_previous(features_deskewed);
    if (report.mapped) mapper.add_scan(features_deskewed, current.T_map_lidar);
    upkeep.go_on(graph.poses(), key_frames, mapper);
  }

  timer.start(Stage::loops);
  Pose T_map_lidar = current.T_map_lidar;
  if (first || new_piece || (good && report.mapped && is_key_frame(T_map_lidar))) {
    report.key_frame = static_cast<int>(key_frames.size());
    scan_of_key_frame.push_back(report.index);
    const std::vector<Eigen::Vector3f> points = deskewed_points(image, current.twist);
    add_key_frame(make_key_frame(image, segmentation, features_deskewed, points, travelled,
                                 settings.key_frames.point_spacing),
                  match);
    close_loops(make_scan_context(points, height, settings.loop.scan_context), report);
    T_map_lidar = T_map_key;
  }

  report.piece = pieces.count() - 1;
  report.T_odom_lidar = of_lidar(current.T_odom_lidar * T_reference_stamp);
  live.push_back({scan.stamp_ns, report.T_odom_lidar});
  fusion.add(scan.stamp_ns, static_cast<int>(key_frames.size()) - 1,
             of_lidar(T_map_key.inverse() * T_map_lidar * T_reference_stamp));
  return report;
}

// LiDAR odometry, 2.3 (3), from the prediction that the last motion goes on.
Motion Slam::State::predict_and_match(const Features& features, double seconds,
                                      ScanReport& report) {
  Motion motion;
  motion.T_previous_current = exp_se3(twist * seconds);
  if (live.empty() || report.status != Status::ok) return motion;
  motion = odometry.estimate(features, motion.T_previous_current, seconds);
  report.odometry_edges = motion.edges;
  report.odometry_planars = motion.planars;
  report.odometry_iterations = motion.iterations;
  return motion;
}

// LiDAR mapping, 2.3 (4): the first good scan makes the map, every n-th of the others is matched
// with it, from the odometry's motion or, when that does not hold, from the prediction.
MapMatch Slam::State::refine(const Features& features, const Motion& motion, double seconds,
                             ScanReport& report) {
  const Pose predicted = exp_se3(twist * seconds);
  // The way of the last displacement at the mean speed. In the axes of a shaking sensor it would be
  // turned by a little each time, which eats it up.
  Pose T_map_predicted = previous.T_map_lidar * predicted;
  const Eigen::Vector3d way = -exp_se3(-twist * seconds).translation().stableNormalized();
  T_map_predicted.translation() = previous.T_map_lidar * Eigen::Vector3d(speed * seconds * way);
  const auto refine_from = [&](const Pose& T_previous_current, bool measured) {
    return mapper.refine(features, {previous.T_map_lidar * T_previous_current, T_map_predicted,
                                    T_previous_current, seconds, measured});
  };
  MapMatch match;
  match.T_map_lidar = previous.T_map_lidar * motion.T_previous_current;
  if (report.status != Status::ok) return match;
  report.mapped = mapper.empty() || report.index % settings.mapping.every == 0;
  if (mapper.empty()) {
    doubt.clear();
    return match;
  }

  if (report.mapped) {
    match = refine_from(motion.T_previous_current, motion.solved);
    if (!match.matched && motion.solved) {
      const MapMatch again = refine_from(predicted, false);
      if (again.matched) match = again;
    }
    correct_elevations(report);
    report.map_points = match.points;
    report.map_matches = match.matches;
    report.map_iterations = match.iterations;
    report.map_rmse = match.rmse;
    report.degenerate_translations = match.localizability.degenerate_translations;
    report.degenerate_rotations = match.localizability.degenerate_rotations;
    report.least_translation_strength = match.localizability.translation[0];
    report.least_rotation_strength = match.localizability.rotation[0];
  }
  if (match.matched) {
    if (match.localizability.degenerate()) report.status = Status::degenerate;
  } else if (report.mapped) {
    report.status = Status::odometry_only;
  }
  if (!doubt.place_is_known(motion.solved, match)) {
    report.status = Status::lost;
    match = {};
    match.T_map_lidar = previous.T_map_lidar * predicted;
  }
  return match;
}

// What the map has shown of the elevation angles holds from the next scan on. It is measured along
// the vertical axis, about which only an upright sensor spins.
void Slam::State::correct_elevations(ScanReport& report) {
  if (sensor.tilted()) return;
  report.elevation_bias_deg = degrees(mapper.elevation_bias());
  sensor.elevation_correction_deg =
      given_sensor.elevation_correction_deg + report.elevation_bias_deg;
  sensor.row_correction_deg.assign(sensor.elevation_deg.size(), 0.0);
  for (std::size_t row = 0; row < mapper.row_bias().size(); ++row)
    sensor.row_correction_deg[row] = degrees(mapper.row_bias()[row]);
}

// The map does not hold where the sensor is now: another one begins, from the prediction.
void Slam::State::begin_piece(ScanReport& report) {
  mapper.clear();
  upkeep.clear();
  pieces.begin(static_cast<int>(key_frames.size()));
  doubt.clear();
  report.mapped = true;
}

bool Slam::State::is_key_frame(const Pose& pose) const {
  const Pose since = T_map_key.inverse() * pose;
  return since.translation().norm() >= settings.key_frames.distance ||
         rotation_angle(since) >= radians(settings.key_frames.rotation_deg);
}

void Slam::State::add_key_frame(const KeyFrame& key_frame, const MapMatch& match) {
  const int number = static_cast<int>(key_frames.size());
  if (number == 0) {
    graph.add_first(match.T_map_lidar);
  } else {
    const Matrix6 covariance =
        pieces.same(number - 1, number)
            ? odometry_covariance(match.covariance, match.T_map_lidar.linear(),
                                  match.localizability, settings.graph)
            : broken_covariance();
    graph.add_key_frame({number - 1, number, T_map_key.inverse() * match.T_map_lidar, covariance});
  }
  T_map_key = match.T_map_lidar;
  upkeep.add(number, T_map_key);
  key_frames.add(key_frame);
}

// Loop closing, 2.3 (5) and (6); a correction that matters here reaches the current pose and the
// local map at once, and all other poses through transform fusion.
void Slam::State::close_loops(ScanContext context, ScanReport& report) {
  report.loops = loop_closer.close(key_frames, std::move(context), pieces, graph);
  bool accepted = false;
  for (LoopReport& loop : report.loops) {
    loop.query_scan = scan_of_key_frame[loop.candidate.query];
    loop.match_scan = scan_of_key_frame[loop.candidate.match];
    report.corrected |= loop.added;
    accepted |= loop.verification.verdict == Verdict::accepted;
  }
  if (accepted && upkeep.follow(graph.poses(), loop_closer.places(), pieces, key_frames, mapper))
    previous.T_map_lidar = T_map_key = graph.poses().back();
}

// All of the above has the LiDAR's axes turned level; poses of the LiDAR leave.
Pose Slam::State::of_lidar(Pose T_frame_level) const {
  if (sensor.tilted()) T_frame_level.rotate(R_base_lidar(sensor));
  return T_frame_level;
}

}  // namespace lego_loam_sc
