// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/pose.hpp"
#include "core/sensor_model.hpp"
#include "io/point_times.hpp"

namespace lego_loam_sc {

/// Facts about a set of scans.
struct DatasetFacts {
  // From dataset.yaml or the header of a scan stream.
  std::optional<std::string> sensor;  ///< name or file for load_sensor
  std::optional<bool> motion_compensated;
  std::optional<double> elevation_correction_deg;
  std::optional<TimeUnit> point_times;

  bool kitti = false;                  ///< a sequence folder of KITTI odometry
  std::optional<Pose> T_camera_lidar;  ///< Tr of KITTI's calib.txt
};

/// Strict: throws InputError, which names `file`, for an unknown key or an invalid value.
DatasetFacts parse_dataset_yaml(const std::string& text, const std::string& file);

/// The line "Tr: r11 r12 r13 t1 ... t3" of KITTI's calib.txt; nothing when it is missing, as in
/// other KITTI benchmarks. Throws InputError, which names `file`, when it is not a rigid transform.
std::optional<Pose> parse_calibration(std::string_view text, const std::string& file);

/// The text of dataset.yaml for these facts.
std::string to_yaml(const DatasetFacts& facts);

/// Writes `folder`/dataset.yaml. Throws InputError when that fails.
void write_dataset_yaml(const std::filesystem::path& folder, const DatasetFacts& facts);

/// The facts in `folder`: from dataset.yaml and calib.txt, where these exist.
DatasetFacts read_dataset_facts(const std::filesystem::path& folder);

/// The sensor with the facts of the data set applied.
SensorModel with_facts(SensorModel sensor, const DatasetFacts& facts);

}  // namespace lego_loam_sc
