// SPDX-License-Identifier: BSD-3-Clause
#include "app/result_writer.hpp"

#include <sys/resource.h>

#include <Eigen/LU>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "core/pose.hpp"
#include "eval/association.hpp"
#include "eval/error_report.hpp"
#include "io/atomic_file.hpp"
#include "io/cloud_writer.hpp"
#include "io/error.hpp"
#include "io/g2o.hpp"
#include "io/sensor_yaml.hpp"
#include "io/settings_yaml.hpp"
#include "io/text.hpp"
#include "io/trajectory.hpp"
#include "slam/map_cloud.hpp"

namespace lego_loam_sc {
namespace {

constexpr const char* kScansHeader =
    "scan,stamp,status,points,ground_points,segment_points,clusters,edges_sharp,planars_flat,"
    "edges_large,planars_large,odometry_edges,odometry_planars,odometry_iterations,map_points,"
    "map_matches,map_iterations,map_rmse_m,degenerate_translations,degenerate_rotations,"
    "translation_strength,rotation_strength,elevation_bias_deg,prediction_m,stamp_jump_s,warnings,"
    "errors,piece,key_frame,corrected,projection_ms,segmentation_ms,features_ms,odometry_ms,"
    "mapping_ms,loops_ms,delay_ms,delay_level\n";

constexpr const char* kLoopsHeader =
    "query,match,query_scan,match_scan,detector,distance,yaw_deg,overlap,rmse_m,x,y,z,roll_deg,"
    "pitch_deg,loop_yaw_deg,added,verdict\n";

// Fields of one line of a CSV file.
class CsvLine {
 public:
  CsvLine& operator<<(std::string_view text) {
    if (!begins_) line_ += ',';
    begins_ = false;
    line_ += text;
    return *this;
  }
  CsvLine& operator<<(const std::string& text) { return *this << std::string_view(text); }
  CsvLine& operator<<(int value) { return *this << std::to_string(value); }
  CsvLine& operator<<(std::size_t value) { return *this << std::to_string(value); }

  std::string text() const { return line_ + "\n"; }

 private:
  std::string line_;
  bool begins_ = true;
};

std::string scan_line(const ScanReport& r, const HealthLog::Line& health) {
  CsvLine line;
  line << r.index << to_seconds(r.stamp_ns) << to_string(r.status) << r.points << r.ground_points
       << r.segment_points << r.clusters << r.edges_sharp << r.planars_flat << r.edges_large
       << r.planars_large << r.odometry_edges << r.odometry_planars << r.odometry_iterations
       << r.map_points << r.map_matches << r.map_iterations << to_fixed(r.map_rmse, 4)
       << r.degenerate_translations << r.degenerate_rotations
       << to_fixed(r.least_translation_strength, 1) << to_fixed(r.least_rotation_strength, 1)
       << to_fixed(r.elevation_bias_deg, 4) << to_fixed(r.prediction_m, 4)
       << to_fixed(r.stamp_jump_s, 3) << health.warnings << health.errors << r.piece << r.key_frame
       << (r.corrected ? 1 : 0);
  for (const double milliseconds : r.milliseconds) line << to_fixed(milliseconds, 3);
  line << to_fixed(health.delay_ms, 3) << to_string(health.delay_level);
  return line.text();
}

std::string loop_line(const LoopReport& r) {
  const LoopVerification& v = r.verification;
  const Eigen::Vector3d t = v.T_match_query.translation();
  const Eigen::Vector3d rpy = rpy_from_rotation(v.T_match_query.linear());
  CsvLine line;
  line << r.candidate.query << r.candidate.match << r.query_scan << r.match_scan
       << to_string(r.candidate.detector) << to_fixed(r.candidate.distance, 4)
       << to_fixed(degrees(r.candidate.yaw), 2) << to_fixed(v.overlap, 3) << to_fixed(v.rmse, 4)
       << to_fixed(t.x(), 4) << to_fixed(t.y(), 4) << to_fixed(t.z(), 4)
       << to_fixed(degrees(rpy.x()), 3) << to_fixed(degrees(rpy.y()), 3)
       << to_fixed(degrees(rpy.z()), 3) << (r.added ? 1 : 0) << to_string(v.verdict);
  return line.text();
}

void write_graph(const std::filesystem::path& path, const PoseGraph& graph) {
  std::vector<G2oVertex> vertices;
  for (std::size_t k = 0; k < graph.size(); ++k)
    vertices.push_back({static_cast<int>(k), graph.poses()[k]});
  std::vector<G2oEdge> edges;
  for (const auto* list : {&graph.odometry_edges(), &graph.loop_edges()})
    for (const PoseEdge& edge : *list)
      edges.push_back({edge.from, edge.to, edge.T_from_to, edge.covariance.inverse()});
  write_g2o(path, vertices, edges);
}

void write_loop_scans(const std::filesystem::path& path, const std::set<int>& numbers,
                      const KeyFrames& key_frames) {
  CloudFile file(path, CloudFormat::ply);
  for (const int number : numbers) file.add(points_of(key_frames[number], number));
  file.commit();
}

// Returns the number of its points.
std::size_t write_map(const std::filesystem::path& folder, const Slam& slam, double voxel_size) {
  CloudFile ply(folder / "map.ply", CloudFormat::ply);
  CloudFile pcd(folder / "map.pcd", CloudFormat::pcd);
  std::size_t count = 0;
  make_map(slam.key_frames(), slam.graph().poses(), voxel_size,
           [&](std::span<const MapPoint> points) {
             ply.add(points);
             pcd.add(points);
             count += points.size();
           });
  ply.commit();
  pcd.commit();
  return count;
}

double path_length(const Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    length += (trajectory[i].pose.translation() - trajectory[i - 1].pose.translation()).norm();
  return length;
}

struct Resources {
  double cpu_seconds;
  double peak_megabytes;
};

Resources used_resources() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime),
          static_cast<double>(usage.ru_maxrss) / 1024.0};
}

// As Linux names it; where it does not, as on some ARM boards, nothing.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      const std::size_t colon = line.find(": ");
      return colon == line.npos ? "" : line.substr(colon + 2);
    }
  return "";
}

// KITTI's truth is the camera's.
PoseFile of_lidar(PoseFile truth, const std::optional<Pose>& T_camera_lidar) {
  if (truth.has_stamps || !T_camera_lidar) return truth;
  for (StampedPose& stamped : truth.poses)
    stamped.pose = T_camera_lidar->inverse() * stamped.pose * *T_camera_lidar;
  return truth;
}

std::vector<NamedError> errors_against(const NamedTruth& truth, const DatasetFacts& dataset,
                                       const Trajectory& odometry, const Trajectory& trajectory) {
  const PoseFile poses = of_lidar(truth.poses, dataset.T_camera_lidar);
  return {{"trajectory", evaluate(associate(poses, {trajectory, true}))},
          {"odometry", evaluate(associate(poses, {odometry, true}))}};
}

}  // namespace

ResultWriter::ResultWriter(std::filesystem::path folder, const SensorModel& sensor,
                           const Settings& settings)
    : folder_(std::move(folder)),
      sensor_(sensor),
      settings_(settings),
      health_(sensor),
      scans_(folder_ / "scans.csv"),
      loops_(folder_ / "loops.csv"),
      odometry_(folder_ / "odometry.tum") {}

void ResultWriter::begin() {
  write_file(folder_ / "settings.yaml", to_yaml(settings_));
  write_file(folder_ / "sensor.yaml", to_yaml(sensor_));
  for (AppendFile* table : {&scans_, &loops_, &odometry_}) table->cut(0);
  scans_.append(kScansHeader);
  loops_.append(kLoopsHeader);
}

void ResultWriter::add(const ScanReport& report) {
  scans_.append(scan_line(report, health_.add(report)));
  if (report.stamp_jump_s != 0.0 && stamp_jumps_++ == 0)
    first_jump_ = ", the first at scan " + std::to_string(report.index) + " by " +
                  to_fixed(report.stamp_jump_s, 1) + " s\n";
  if (report.status != Status::out_of_order)
    odometry_.append(tum_line({report.stamp_ns, report.T_odom_lidar}));
  for (const LoopReport& loop : report.loops) {
    loops_.append(loop_line(loop));
    if (loop.verification.verdict == Verdict::accepted) {
      loop_key_frames_.insert({loop.candidate.query, loop.candidate.match});
      ++accepted_loops_;
    } else {
      ++refused_loops_;
    }
  }
  ++scan_count_;
  ++statuses_[std::string(to_string(report.status))];
}

std::string ResultWriter::finish(const Slam& slam, const DatasetFacts& dataset,
                                 const RunFacts& facts) {
  const Trajectory trajectory = slam.trajectory();
  write_tum(folder_ / "trajectory.tum", trajectory);
  write_kitti(folder_ / "trajectory_kitti.txt", trajectory, dataset.T_camera_lidar);
  write_graph(folder_ / "graph.g2o", slam.graph());
  // What goes wrong from here on is said in the end: the rest of the results is worth no less.
  std::optional<InputError> fault;
  std::size_t map_points = 0;
  try {
    write_loop_scans(folder_ / "loop_scans.ply", loop_key_frames_, slam.key_frames());
    map_points = write_map(folder_, slam, settings_.output.map_voxel_size);
  } catch (const InputError& error) {
    fault = error;
  }

  const double length = path_length(trajectory);
  const Resources resources = used_resources();
  const double milliseconds_per_scan =
      scan_count_ > 0 ? 1e3 * resources.cpu_seconds / static_cast<double>(scan_count_) : 0.0;
  const Eigen::Vector3d mounting = rpy_from_rotation(slam.R_level_lidar());
  nlohmann::ordered_json summary = {
      {"version", LEGO_LOAM_SC_VERSION},
      {"input", facts.input},
      {"method", facts.method},
      {"sensor", facts.sensor},
      {"sensor_height_m", slam.sensor_height()},
      {"mount_roll_deg", degrees(mounting[0]) + 0.0},  // no minus before a zero
      {"mount_pitch_deg", degrees(mounting[1]) + 0.0},
      {"scans", scan_count_},
      {"status", statuses_},
      {"stamp_jumps", stamp_jumps_},
      {"health", health_.to_json()},
      {"key_frames", slam.key_frames().size()},
      {"maps", slam.maps()},
      {"loops_accepted", accepted_loops_},
      {"loops_refused", refused_loops_},
      {"path_length_m", length},
      {"map_points", map_points},
      {"interrupted", facts.interrupted},
      {"faults", facts.faults},
      {"timing",
       {{"threads", facts.threads},
        {"wall_seconds", facts.wall_seconds},
        {"cpu_seconds", resources.cpu_seconds},
        {"cpu_ms_per_scan", milliseconds_per_scan},
        {"peak_memory_mb", resources.peak_megabytes},
        {"processor", processor_name()},
        {"processors", std::thread::hardware_concurrency()},
        {"delay", health_.to_json(Vital::delay)}}}};
  char text[512];
  std::snprintf(text, sizeof text,
                "%zu scans, %.1f m, %zu key frames, %zu loops, %zu map points\n"
                "%.1f s wall, %.1f s CPU (%.1f ms per scan), %.0f MB\n",
                scan_count_, length, slam.key_frames().size(), accepted_loops_, map_points,
                facts.wall_seconds, resources.cpu_seconds, milliseconds_per_scan,
                resources.peak_megabytes);
  std::string report = text;
  for (const auto& [status, count] : statuses_)
    if (status != to_string(Status::ok))
      report += std::to_string(count) + " scans " + status + "\n";
  if (stamp_jumps_ > 0)
    report +=
        "jumps of the stamps that were bridged: " + std::to_string(stamp_jumps_) + first_jump_;
  if (slam.maps() > 1)
    report += "the way was lost: " + std::to_string(slam.maps()) +
              " maps that no loop joins, where they lie to each other is a guess\n";
  report += health_.text();
  try {
    if (facts.truth) {
      const std::vector<NamedError> errors =
          errors_against(*facts.truth, dataset, slam.odometry(), trajectory);
      summary["errors"]["truth"] = facts.truth->file;
      for (const auto& [name, error] : errors) summary["errors"][name] = to_json(error);
      report += error_table(errors);
    }
  } catch (const InputError& error) {
    if (!fault) fault.emplace(facts.truth->file + ": " + error.what());
  }
  // A file name need not be UTF-8.
  write_file(folder_ / "summary.json",
             summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  if (fault) throw *fault;
  return report;
}

}  // namespace lego_loam_sc
