// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>

#include "core/pose.hpp"
#include "core/scan.hpp"
#include "io/dataset_facts.hpp"

namespace lego_loam_sc {

/// Writes scans and ground truth as a KITTI sequence folder:
///   velodyne/000000.bin   float32 x y z intensity, in the order of the scan
///   times.txt             seconds of each scan
///   calib.txt             Tr: LiDAR to a camera at the same position (x right, y down, z forward)
///   poses.txt             ground truth of the camera relative to its first pose, as in KITTI
///   truth.tum             ground truth of the LiDAR frame in the world frame
///   dataset.yaml          the facts
/// Each scan is on disk when `add` returns, so an interrupted run leaves a complete data set.
class KittiFolder {
 public:
  /// Creates the folder. Throws InputError when it is not empty or cannot be created.
  KittiFolder(std::filesystem::path folder, const DatasetFacts& facts);

  /// Throws InputError when the scan cannot be written.
  void add(const Scan& scan, const Pose& T_world_lidar);

 private:
  std::filesystem::path folder_;
  std::ofstream times_, poses_, truth_;
  Pose T_first_world_ = Pose::Identity();
  int scans_ = 0;
};

}  // namespace lego_loam_sc
