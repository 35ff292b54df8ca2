// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/trajectory.hpp"

namespace lego_loam_sc {

/// The axes of KITTI's camera: x right, y down, z forward.
Eigen::Matrix3d R_camera_lidar();

/// A line of a TUM file with line end: stamp (s), x y z (m), qx qy qz qw; nine decimals.
std::string tum_line(const StampedPose& stamped);

/// A line of a KITTI file with line end: the upper three rows of the pose's matrix; nine decimals.
std::string kitti_line(const Pose& pose);

/// Writes a TUM file, replacing an existing one atomically. Throws InputError when that fails.
void write_tum(const std::filesystem::path& path, const Trajectory& trajectory);

/// The same as a KITTI file. With `T_camera_lidar` (Tr of calib.txt) the poses are those of the
/// camera, as in KITTI's files.
void write_kitti(const std::filesystem::path& path, const Trajectory& trajectory,
                 const std::optional<Pose>& T_camera_lidar = std::nullopt);

/// The content of a pose file.
struct PoseFile {
  Trajectory poses;        ///< in the order of the file
  bool has_stamps = true;  ///< false for KITTI files, where `stamp_ns` is the index of the pose
};

/// Reads a TUM (8 columns) or KITTI (12 columns) file; `#` starts a comment. Throws InputError
/// that names file and line when a line is neither, has no valid rotation or differs from the
/// others.
PoseFile read_poses(const std::filesystem::path& path);

/// The same for the text of a file, which `file` names in messages.
PoseFile parse_poses(std::string_view text, const std::string& file);

/// Reads the trajectory of a vehicle: a TUM file (x forward, y left, z up, with stamps), or a KITTI
/// file (poses of the camera, ten a second), whose poses are turned to the axes of the former.
/// Throws InputError as read_poses does.
Trajectory read_route(const std::filesystem::path& path);

}  // namespace lego_loam_sc
