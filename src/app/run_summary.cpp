// SPDX-License-Identifier: BSD-3-Clause
#include "app/run_summary.hpp"

#include <sys/resource.h>

#include <cstdio>
#include <fstream>
#include <optional>
#include <thread>
#include <vector>

#include "app/input_findings.hpp"
#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/text.hpp"
#include "eval/association.hpp"
#include "eval/error_report.hpp"

namespace lego_loam_sc {
namespace {

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

// Empty where Linux does not name it, as on some ARM boards.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      const std::size_t colon = line.find(": ");
      return colon == line.npos ? "" : line.substr(colon + 2);
    }
  return "";
}

// KITTI gives the truth in the camera frame.
PoseFile to_lidar_frame(PoseFile truth, const std::optional<Pose>& T_camera_lidar) {
  if (truth.has_stamps || !T_camera_lidar) return truth;
  for (StampedPose& stamped : truth.poses)
    stamped.pose = T_camera_lidar->inverse() * stamped.pose * *T_camera_lidar;
  return truth;
}

// A line for each correction of the sensor that was found and is in force.
std::string corrections_of(const Calibration& calibration) {
  const SensorModel& sensor = calibration.sensor;
  std::string text;
  if (sensor.tilted() && !calibration.nominal.tilted())
    text += "tilt of the sensor, found in the first two scans: roll " +
            to_fixed(sensor.mount_roll_deg, 1) + ", pitch " + to_fixed(sensor.mount_pitch_deg, 1) +
            " deg\n";
  if (calibration.elevation_bias_deg() != 0.0)
    text += "elevation angles corrected by " + to_fixed(calibration.elevation_bias_deg(), 3) +
            " +- " + to_fixed(calibration.elevation_bias_sigma_deg(), 3) +
            " deg, found on the way: elevation_correction_deg: " +
            to_fixed(sensor.elevation_correction_deg, 3) +
            " in the sensor's file corrects the drive from its start\n";
  return text;
}

// A line for each exceptional event of the run.
std::string notes_of(const RunCounts& counts, int maps) {
  std::string text;
  for (const auto& [status, count] : counts.statuses)
    if (status != to_string(Status::ok)) text += std::to_string(count) + " scans " + status + "\n";
  if (counts.stamp_jumps > 0)
    text += "time stamp jumps bridged: " + std::to_string(counts.stamp_jumps) + ", first at scan " +
            std::to_string(counts.first_jump_scan) + " by " + to_fixed(counts.first_jump_s, 1) +
            " s\n";
  if (maps > 1)
    text += "tracking was lost: " + std::to_string(maps) +
            " maps that no loop joins, their relative poses are unconstrained\n";
  return text;
}

nlohmann::ordered_json to_json(const std::vector<DoubtReason>& reasons) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const DoubtReason& reason : reasons)
    json.push_back({{"reason", reason.text},
                    {"scans", reason.scans},
                    {"first_scan", reason.first},
                    {"last_scan", reason.last}});
  return json;
}

}  // namespace

RunSummary summarise(const Slam& slam, const Trajectory& trajectory, std::size_t map_points,
                     const RunCounts& counts, const HealthLog& health, const RunFacts& facts) {
  const double length = path_length(trajectory);
  const Resources resources = used_resources();
  const double milliseconds_per_scan =
      counts.scans > 0 ? 1e3 * resources.cpu_seconds / static_cast<double>(counts.scans) : 0.0;
  const Eigen::Vector3d mounting = rpy_from_rotation(slam.R_level_lidar());
  const RunVerdict verdict = counts.assessment.verdict(slam.maps());
  nlohmann::ordered_json json = {
      {"version", LEGO_LOAM_SC_VERSION},
      {"input", facts.input},
      {"method", facts.method},
      {"sensor", facts.sensor},
      {"sensor_height_m", slam.sensor_height()},
      {"mount_roll_deg", degrees(mounting[0]) + 0.0},  // no minus before a zero
      {"mount_pitch_deg", degrees(mounting[1]) + 0.0},
      {"elevation_bias_deg", slam.calibration().elevation_bias_deg()},
      {"elevation_bias_sigma_deg", slam.calibration().elevation_bias_sigma_deg()},
      {"scans", counts.scans},
      {"verdict", to_string(verdict.trust)},
      {"verdict_reasons", to_json(verdict.reasons)},
      {"status", counts.statuses},
      {"stamp_jumps", counts.stamp_jumps},
      {"health", health.to_json()},
      {"key_frames", slam.key_frames().size()},
      {"maps", slam.maps()},
      {"loops_accepted", counts.accepted_loops},
      {"loops_refused", counts.refused_loops},
      {"path_length_m", length},
      {"map_points", map_points},
      {"interrupted", facts.interrupted},
      {"faults", facts.faults},
      {"input_notes", facts.notes},
      {"input_check", input_json(slam)},
      {"timing",
       {{"threads", facts.threads},
        {"wall_seconds", facts.wall_seconds},
        {"cpu_seconds", resources.cpu_seconds},
        {"cpu_ms_per_scan", milliseconds_per_scan},
        {"peak_memory_mb", resources.peak_megabytes},
        {"processor", processor_name()},
        {"processors", std::thread::hardware_concurrency()},
        {"delay", health.to_json(Vital::delay)}}}};
  char text[512];
  std::snprintf(text, sizeof text,
                "%zu scans, %.1f m, %zu key frames, %zu loops, %zu map points\n"
                "%.1f s wall, %.1f s CPU (%.1f ms per scan), %.0f MB\n",
                counts.scans, length, slam.key_frames().size(), counts.accepted_loops, map_points,
                facts.wall_seconds, resources.cpu_seconds, milliseconds_per_scan,
                resources.peak_megabytes);
  std::string findings;
  for (const std::string& sentence : input_sentences(slam)) findings += sentence + "\n";
  return {std::move(json),
          text + corrections_of(slam.calibration()) + notes_of(counts, slam.maps()) +
              health.text() + findings,
          describe(verdict)};
}

void add_errors(const NamedTruth& truth, const DatasetFacts& dataset, const Trajectory& odometry,
                const Trajectory& trajectory, RunSummary& summary) {
  const PoseFile poses = to_lidar_frame(truth.poses, dataset.T_camera_lidar);
  std::vector<NamedError> errors;
  try {
    errors = {{"trajectory", evaluate(associate(poses, {trajectory, true}))},
              {"odometry", evaluate(associate(poses, {odometry, true}))}};
  } catch (const InputError& error) {
    throw InputError(truth.file + ": " + error.what());
  }
  summary.json["errors"]["truth"] = truth.file;
  for (const auto& [name, error] : errors) summary.json["errors"][name] = to_json(error);
  summary.text += error_table(errors);
}

}  // namespace lego_loam_sc
