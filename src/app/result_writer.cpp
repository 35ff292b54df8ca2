// SPDX-License-Identifier: BSD-3-Clause
#include "app/result_writer.hpp"

#include <Eigen/LU>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/result_tables.hpp"
#include "app/run_summary.hpp"
#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/cloud_writer.hpp"
#include "io/g2o.hpp"
#include "io/sensor_yaml.hpp"
#include "io/settings_yaml.hpp"
#include "io/trajectory.hpp"
#include "key_frames/map_cloud.hpp"

namespace lego_loam_sc {
namespace {

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

}  // namespace

ResultWriter::ResultWriter(std::filesystem::path folder, const SensorModel& sensor,
                           const Settings& settings)
    : folder_(std::move(folder)),
      sensor_(sensor),
      settings_(settings),
      health_(sensor, settings.health),
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
  counts_.add(report);
  scans_.append(scan_line(report, health_.add(report)));
  if (report.status != Status::out_of_order)
    odometry_.append(tum_line({report.stamp_ns, report.T_odom_lidar}));
  for (const LoopReport& loop : report.loops) {
    loops_.append(loop_line(loop));
    if (loop.verification.verdict == Verdict::accepted)
      loop_key_frames_.insert({loop.candidate.query, loop.candidate.match});
  }
}

RunSummary ResultWriter::finish(const Slam& slam, const DatasetFacts& dataset,
                                const RunFacts& facts) {
  const Trajectory trajectory = slam.trajectory();
  write_tum(folder_ / "trajectory.tum", trajectory);
  write_kitti(folder_ / "trajectory_kitti.txt", trajectory, dataset.T_camera_lidar);
  write_graph(folder_ / "graph.g2o", slam.graph());
  // A fault from here on is thrown at the end, after all other files are written.
  std::optional<InputError> fault;
  std::size_t map_points = 0;
  try {
    write_loop_scans(folder_ / "loop_scans.ply", loop_key_frames_, slam.key_frames());
    map_points = write_map(folder_, slam, settings_.output.map_voxel_size);
  } catch (const InputError& error) {
    fault = error;
  }

  RunSummary summary = summarise(slam, trajectory, map_points, counts_, health_, facts);
  try {
    if (facts.truth) add_errors(*facts.truth, dataset, slam.odometry(), trajectory, summary);
  } catch (const InputError& error) {
    if (!fault) fault = error;
  }
  // A file name need not be UTF-8.
  write_file(folder_ / "summary.json",
             summary.json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  if (fault) throw InputError(*fault);
  return summary;
}

}  // namespace lego_loam_sc
