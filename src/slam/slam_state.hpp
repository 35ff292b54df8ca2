// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "graph/map_fragments.hpp"
#include "loop/loop_closer.hpp"
#include "mapping/mapper.hpp"
#include "odometry/odometry.hpp"
#include "slam/slam.hpp"
#include "slam/transform_fusion.hpp"
#include "tracking/local_map_updater.hpp"
#include "tracking/scan_clock.hpp"
#include "tracking/tracking_monitor.hpp"

namespace lego_loam_sc {

/// A scan at its reference time.
struct Placed {
  std::int64_t reference_ns = 0;
  Pose T_map_lidar = Pose::Identity();
  Pose T_odom_lidar = Pose::Identity();
  Vector6 twist = Vector6::Zero();  // m/s and rad/s, of the sensor in its own axes

  template <class Archive>
  void state(Archive& archive) {
    archive(reference_ns, T_map_lidar, T_odom_lidar, twist);
  }
};

/// All that a Slam knows, and what it does with a scan.
struct Slam::State {
  State(const SensorModel& sensor_model, const Settings& slam_settings, int threads,
        LoopDetector loop_detector, std::shared_ptr<BlobStore> blob_store)
      : given_sensor(sensor_model),
        sensor(sensor_model),
        settings(slam_settings),
        detector(std::move(loop_detector)),
        point_store(std::move(blob_store)),
        arena(std::max(threads, 1)),
        clock(sensor.period),
        height(sensor.height),
        odometry(settings.odometry, sensor.range_noise),
        mapper(settings.mapping, sensor.range_noise, row_spacing(sensor)),
        loop_closer(settings.loop, settings.graph, sensor.range_noise, detector),
        graph(settings.graph),
        upkeep(settings.mapping.radius),
        key_frames(point_store) {}

  ScanReport process(const Scan& scan);
  Motion predict_and_match(const Features& features, double seconds, ScanReport& report);
  MapMatch refine(const Features& features, const Motion& motion, double seconds,
                  ScanReport& report);
  bool is_key_frame(const Pose& pose) const;
  void correct_elevations(ScanReport& report);
  void begin_piece(ScanReport& report);
  void add_key_frame(const KeyFrame& key_frame, const MapMatch& match);
  void close_loops(ScanContext context, ScanReport& report);
  Pose of_lidar(Pose T_frame_level) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(sensor.mount_roll_deg, sensor.mount_pitch_deg, sensor.elevation_correction_deg,
            sensor.row_correction_deg, clock, height, odometry, mapper, loop_closer, graph, pieces,
            upkeep, T_map_key, fusion, key_frames, scans, previous, twist, speed, travelled, doubt);
    archive.grown(scan_of_key_frame);
    archive.grown(live);
  }

  SensorModel given_sensor;
  SensorModel sensor;  // the same with the tilt and the elevations that were found on the way
  Settings settings;
  LoopDetector detector;
  std::shared_ptr<BlobStore> point_store;
  tbb::task_arena arena;
  ScanClock clock;

  double height;  // m, 0 = not known yet
  Odometry odometry;
  Mapper mapper;
  LoopCloser loop_closer;
  PoseGraph graph;
  MapFragments pieces;
  LocalMapUpdater upkeep;
  Pose T_map_key = Pose::Identity();  // the last key frame, where the mapper has it
  TransformFusion fusion;
  KeyFrames key_frames;
  std::vector<int> scan_of_key_frame;
  Trajectory live;

  std::optional<Scan> first_scan;  // until its motion is known, see Slam::process
  int scans = 0;
  Placed previous;                  // the last scan that was matched
  Vector6 twist = Vector6::Zero();  // of that scan, m/s and rad/s
  double speed = 0.0;               // m/s, mean of the last scans whose motion the map told
  double travelled = 0.0;           // m
  TrackingMonitor doubt;
};

}  // namespace lego_loam_sc
