// SPDX-License-Identifier: BSD-3-Clause
#include "io/kitti_folder.hpp"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/atomic_file.hpp"
#include "io/trajectory.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

// The camera is at the position of the LiDAR.
Pose make_T_camera_lidar() {
  Pose T_camera_lidar = Pose::Identity();
  T_camera_lidar.linear() = R_camera_lidar();
  return T_camera_lidar;
}

std::string bin_name(int scan) {
  char name[32];
  std::snprintf(name, sizeof(name), "%06d.bin", scan);
  return name;
}

std::string bin_bytes(const Scan& scan) {
  std::vector<float> values;
  values.reserve(4 * scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    values.insert(values.end(), {p.x(), p.y(), p.z(), scan.intensity[i]});
  }
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

}  // namespace

KittiFolder::KittiFolder(fs::path folder, const DatasetFacts& facts) : folder_(std::move(folder)) {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_empty(folder_, error))
    throw InputError(folder_.string() + " is not empty; give a new folder");
  fs::create_directories(folder_ / "velodyne", error);
  if (error) throw InputError(folder_.string() + " cannot be created: " + error.message());
  write_file(folder_ / "calib.txt", "Tr: " + kitti_line(make_T_camera_lidar()));
  write_dataset_yaml(folder_, facts);
  times_.open(folder_ / "times.txt");
  poses_.open(folder_ / "poses.txt");
  truth_.open(folder_ / "truth.tum");
}

void KittiFolder::add(const Scan& scan, const Pose& T_world_lidar) {
  if (scans_ == 0) T_first_world_ = T_world_lidar.inverse();
  const Pose T_camera_lidar = make_T_camera_lidar();
  write_file(folder_ / "velodyne" / bin_name(scans_), bin_bytes(scan));
  times_ << to_seconds(scan.stamp_ns) << '\n' << std::flush;
  poses_ << kitti_line(T_camera_lidar * T_first_world_ * T_world_lidar * T_camera_lidar.inverse())
         << std::flush;
  truth_ << tum_line({scan.stamp_ns, T_world_lidar}) << std::flush;
  if (!times_ || !poses_ || !truth_)
    throw InputError("times and poses cannot be written to " + folder_.string() +
                     "; free space on the disk");
  ++scans_;
}

}  // namespace lego_loam_sc
