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

/// A line of a TUM file: stamp (s), x y z (m), qx qy qz qw; nine decimals, with line end.
std::string tum_line(const StampedPose& stamped);

/// A line of a KITTI file: the upper three rows of the pose's matrix; nine decimals, with line end.
std::string kitti_line(const Pose& pose);

/// Write whole files, replacing an old one at once. Throw InputError when that fails.
void write_tum(const std::filesystem::path& path, const Trajectory& trajectory);

/// With `T_camera_lidar` (Tr of calib.txt) the poses become those of the camera, as KITTI's own.
void write_kitti(const std::filesystem::path& path, const Trajectory& trajectory,
                 const std::optional<Pose>& T_camera_lidar = std::nullopt);

/// What a file of poses says.
struct PoseFile {
  Trajectory poses;        ///< in the order of the file
  bool has_stamps = true;  ///< false for KITTI files; then `stamp_ns` is the index of the pose
};

/// Reads a TUM (8 columns) or KITTI (12 columns) file; `#` starts a comment. Throws InputError
/// that names file and line when a line is neither, is no rotation or differs from the others.
PoseFile read_poses(const std::filesystem::path& path);

/// The same for the text of a file; messages begin with `file`.
PoseFile parse_poses(std::string_view text, const std::string& file);

/// Reads the trajectory of a vehicle: a TUM file (x forward, y left, z up, with stamps), or a KITTI
/// file (poses of the camera, ten a second), whose poses are turned to the axes of the former.
/// Throws InputError as read_poses does.
Trajectory read_route(const std::filesystem::path& path);

}  // namespace lego_loam_sc
