// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/eigen/dense.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <lego_loam_sc/io/trajectory.hpp>
#include <lego_loam_sc/key_frames/map_cloud.hpp>
#include <lego_loam_sc/slam/slam.hpp>
#include <stdexcept>
#include <string>

#include "module.hpp"
#include "scans.hpp"

namespace lego_loam_sc::python {
namespace {

using namespace nb::literals;

// Beside lego_loam_sc::Trajectory a type of its own, which Python can hold.
struct PythonTrajectory {
  Trajectory poses;
};

constexpr std::size_t kPoseDoubles = sizeof(StampedPose) / sizeof(double);
static_assert(sizeof(StampedPose) % sizeof(double) == 0);

void bind_trajectory(nb::module_& module) {
  nb::class_<PythonTrajectory>(module, "Trajectory",
                               "Poses and their stamps, in the order of time.")
      .def("__len__", [](const PythonTrajectory& t) { return t.poses.size(); })
      .def_prop_ro(
          "poses",
          [](const PythonTrajectory& t) {
            // Where the poses lie, column by column, with a stamp between each two.
            const double* first = t.poses.empty() ? nullptr : t.poses.front().pose.data();
            return View<double, -1, 4, 4>(first, {t.poses.size(), 4, 4}, {},
                                          {static_cast<std::int64_t>(kPoseDoubles), 1, 4});
          },
          nb::rv_policy::reference_internal, "(n, 4, 4)")
      .def_prop_ro(
          "stamps",
          [](const PythonTrajectory& t) {
            std::vector<double> stamps;
            for (const StampedPose& pose : t.poses) stamps.push_back(seconds(pose.stamp_ns));
            return to_numpy<double>(std::move(stamps));
          },
          nb::rv_policy::automatic, "(n,), s")
      .def(
          "write_tum",
          [](const PythonTrajectory& t, const std::filesystem::path& path) {
            write_tum(path, t.poses);
          },
          "path"_a, "Lines of stamp x y z qx qy qz qw.");
}

void bind_reports(nb::module_& module) {
  nb::enum_<Status> status(module, "Status", "What became of a scan.");
  for (int k = 0; k <= static_cast<int>(Status::out_of_order); ++k) {
    const auto value = static_cast<Status>(k);
    status.value(to_string(value).data(), value);
  }

  nb::class_<LoopReport>(module, "LoopReport", "What became of a loop candidate.")
      .def_prop_ro(
          "query", [](const LoopReport& r) { return r.candidate.query; }, "key frame")
      .def_prop_ro(
          "match", [](const LoopReport& r) { return r.candidate.match; }, "key frame")
      .def_ro("query_scan", &LoopReport::query_scan)
      .def_ro("match_scan", &LoopReport::match_scan)
      .def_prop_ro("detector",
                   [](const LoopReport& r) { return to_string(r.candidate.detector).data(); })
      .def_prop_ro(
          "distance", [](const LoopReport& r) { return r.candidate.distance; },
          "D of equation (5), or m for the radius search")
      .def_ro("verification", &LoopReport::verification)
      .def_ro("added", &LoopReport::added, "to the pose graph, to which it was news");

  using R = ScanReport;
  nb::class_<R>(module, "ScanReport", "What became of a scan; the columns of scans.csv.")
      .def_ro("index", &R::index)
      .def_prop_ro(
          "stamp", [](const R& r) { return seconds(r.stamp_ns); }, "s")
      .def_ro("status", &R::status)
      .def_prop_ro(
          "T_odom_lidar", [](const R& r) { return r.T_odom_lidar.matrix(); },
          "live pose at the stamp, before any loop")
      .def_ro("points", &R::points)
      .def_ro("ground_points", &R::ground_points)
      .def_ro("segment_points", &R::segment_points)
      .def_ro("clusters", &R::clusters)
      .def_ro("map_matches", &R::map_matches)
      .def_ro("map_rmse", &R::map_rmse, "m")
      .def_ro("degenerate_translations", &R::degenerate_translations)
      .def_ro("degenerate_rotations", &R::degenerate_rotations)
      .def_ro("piece", &R::piece, "of the drive, from 0; a new one begins where the way was lost")
      .def_ro("key_frame", &R::key_frame, "its number when the scan is one, else -1")
      .def_ro("loops", &R::loops, "every candidate that was verified")
      .def_ro("corrected", &R::corrected, "a loop came into the pose graph");
}

void bind_loop_edge(nb::module_& module) {
  nb::class_<PoseEdge>(module, "LoopEdge", "A loop in the pose graph.")
      .def_ro("match", &PoseEdge::from, "key frame of the earlier visit")
      .def_ro("query", &PoseEdge::to, "key frame of the later visit")
      .def_prop_ro("T_match_query", [](const PoseEdge& e) { return e.T_from_to.matrix(); })
      .def_ro("covariance", &PoseEdge::covariance,
              "of translation (m), then rotation (rad), in the axes of the query");
}

ScanReport process(Slam& slam, const Scan& scan) {
  nb::gil_scoped_release unlocked;
  return slam.process(scan);
}

PythonTrajectory key_frames(const Slam& slam) {
  PythonTrajectory result;
  for (std::size_t k = 0; k < slam.key_frames().size(); ++k)
    result.poses.push_back({slam.key_frames().reference_ns(k), slam.graph().poses()[k]});
  return result;
}

std::vector<Eigen::Vector4f> to_rows(const std::vector<MapPoint>& points) {
  std::vector<Eigen::Vector4f> rows;
  for (const MapPoint& p : points)
    rows.emplace_back(p.position.x(), p.position.y(), p.position.z(), p.intensity);
  return rows;
}

std::vector<Eigen::Vector4f> key_frame_points(const Slam& slam, std::size_t number) {
  if (number >= slam.key_frames().size())
    throw nb::index_error(("there are " + std::to_string(slam.key_frames().size()) +
                           " key frames, no number " + std::to_string(number))
                              .c_str());
  return to_rows(points_of(slam.key_frames()[number], static_cast<std::int32_t>(number)));
}

}  // namespace

void bind_slam(nb::module_& module) {
  bind_trajectory(module);
  bind_reports(module);
  bind_loop_edge(module);

  nb::class_<Slam>(
      module, "Slam",
      "Takes the scans of one LiDAR in the order of time. The map frame is the sensor's\n"
      "frame at the first scan. Raises ValueError when a setting is not valid.")
      .def(nb::init<const SensorModel&, const Settings&, int>(), "sensor"_a,
           "settings"_a = Settings{}, "threads"_a = 1)
      .def("process", &process, "scan"_a, "Processes the next scan; a bad one is a Status.")
      .def(
          "process",
          [](Slam& slam, const Points& points, double stamp,
             const std::optional<Numbers<double>>& offsets,
             const std::optional<Numbers<std::int64_t>>& rings,
             const std::optional<Numbers<float>>& intensity) {
            return process(slam, make_scan(points, stamp, offsets, rings, intensity));
          },
          nb::sig("def process(self, points: numpy.typing.NDArray[numpy.number], *, stamp: float, "
                  "offsets: numpy.typing.NDArray[numpy.number] | None = None, "
                  "rings: numpy.typing.NDArray[numpy.number] | None = None, "
                  "intensity: numpy.typing.NDArray[numpy.number] | None = None) -> ScanReport"),
          "points"_a, nb::kw_only(), "stamp"_a, "offsets"_a = nb::none(), "rings"_a = nb::none(),
          "intensity"_a = nb::none(), "The same from arrays, as Scan takes them.")
      .def(
          "odometry", [](const Slam& slam) { return PythonTrajectory{slam.odometry()}; },
          "The live poses of all scans, before any loop.")
      .def(
          "trajectory", [](const Slam& slam) { return PythonTrajectory{slam.trajectory()}; },
          "The poses of all scans after all loops.")
      .def("key_frames", &key_frames, "The poses of the key frames after all loops.")
      .def(
          "key_frame_points",
          [](const Slam& slam, std::size_t number) {
            return to_numpy<float, 4>(key_frame_points(slam, number));
          },
          "number"_a, "(n, 4): x y z in its LiDAR frame and intensity, thinned out.")
      .def(
          "loops", [](const Slam& slam) { return slam.graph().loop_edges(); },
          "The loops that the pose graph holds.")
      .def(
          "map",
          [](const Slam& slam, double voxel_size) {
            if (!(voxel_size > 0.0)) throw std::invalid_argument("voxel_size must be above 0 m");
            return to_numpy<float, 4>(
                to_rows(make_map(slam.key_frames(), slam.graph().poses(), voxel_size)));
          },
          "voxel_size"_a = OutputSettings{}.map_voxel_size,
          "(n, 4): x y z in the map frame and intensity, a point for each voxel.")
      .def_prop_ro("sensor_height", &Slam::sensor_height, "m above the ground, 0 while unknown");
}

}  // namespace lego_loam_sc::python
