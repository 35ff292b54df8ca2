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

/// What is known about a set of scans besides the scans.
struct DatasetFacts {
  // In dataset.yaml and in the header of a scan stream.
  std::optional<std::string> sensor;  ///< as load_sensor takes it
  std::optional<bool> motion_compensated;
  std::optional<double> elevation_correction_deg;
  std::optional<TimeUnit> point_times;

  bool kitti = false;                  ///< a sequence folder as KITTI odometry lays it out
  std::optional<Pose> T_camera_lidar;  ///< Tr of KITTI's calib.txt
};

/// Strict: throws InputError, which begins with `file`, for an unknown key or a bad value.
DatasetFacts parse_dataset_yaml(const std::string& text, const std::string& file);

/// The line "Tr: r11 r12 r13 t1 ... t3" of KITTI's calib.txt; files of other KITTI benchmarks have
/// none. Throws InputError, which begins with `file`, when it is no rigid transform.
std::optional<Pose> parse_calibration(std::string_view text, const std::string& file);

/// The facts that dataset.yaml holds, as its text.
std::string to_yaml(const DatasetFacts& facts);

/// Writes `folder`/dataset.yaml. Throws InputError when that fails.
void write_dataset_yaml(const std::filesystem::path& folder, const DatasetFacts& facts);

/// The facts in `folder`: dataset.yaml and calib.txt, each when it is there.
DatasetFacts read_dataset_facts(const std::filesystem::path& folder);

/// The sensor with what the data set says about its scans.
SensorModel with_facts(SensorModel sensor, const DatasetFacts& facts);

}  // namespace lego_loam_sc
