// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>

#include "core/pose.hpp"
#include "core/scan.hpp"
#include "io/dataset_facts.hpp"

namespace lego_loam_sc {

/// Writes scans and their truth as a folder in the form of a KITTI sequence:
///   velodyne/000000.bin   float32 x y z intensity, in the order of the scan
///   times.txt             seconds of each scan
///   calib.txt             Tr: LiDAR to a camera at the same place (x right, y down, z forward)
///   poses.txt             the truth as KITTI gives it: the camera's, the first is the identity
///   truth.tum             the truth of the LiDAR frame in the world frame
///   dataset.yaml          the facts
/// Each scan is on the disk when `add` returns, so that an interrupted run leaves a whole data set.
class KittiFolder {
 public:
  /// Makes the folder. Throws InputError when it is there and not empty or cannot be made.
  KittiFolder(std::filesystem::path folder, const DatasetFacts& facts);

  /// Throws InputError when the disk does not take the scan.
  void add(const Scan& scan, const Pose& T_world_lidar);

 private:
  std::filesystem::path folder_;
  std::ofstream times_, poses_, truth_;
  Pose T_first_world_ = Pose::Identity();
  int scans_ = 0;
};

}  // namespace lego_loam_sc
