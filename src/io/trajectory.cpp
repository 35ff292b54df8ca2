// SPDX-License-Identifier: BSD-3-Clause
#include "io/trajectory.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/atomic_file.hpp"
#include "io/file.hpp"

namespace lego_loam_sc {
namespace {

constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kKittiColumns = 12;
// Files may be rounded to three digits.
constexpr double kRotationTolerance = 0.02;

using Numbers = std::array<double, kKittiColumns>;  // the longer of the two

// Parses the numbers of a line and returns their count; those that do not fit are only counted.
std::size_t parse_numbers(std::string_view line, Numbers& numbers, const std::string& where) {
  std::size_t count = 0;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++count) {
    const auto value = parse_double(word);
    if (!value || !std::isfinite(*value))
      throw InputError(where + ": \"" + std::string(word.substr(0, 40)) + "\" is not a number");
    if (count < numbers.size()) numbers[count] = *value;
  }
  return count;
}

// Not as a double, which would round it.
std::int64_t parse_stamp(std::string_view line, const std::string& where) {
  const std::string_view word = take_word(line);
  const auto stamp_ns = parse_seconds(word);
  if (!stamp_ns)
    throw InputError(where + ": the stamp " + std::string(word) + " is not in seconds");
  return *stamp_ns;
}

Pose pose_from_tum(const Numbers& v, const std::string& where) {
  const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
  if (!(std::abs(q.norm() - 1.0) < kRotationTolerance))
    throw InputError(where + ": qx qy qz qw has length " + to_text(q.norm()) +
                     ", a rotation has length 1");
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[1], v[2], v[3]);
  return pose;
}

Pose pose_from_kitti(const Numbers& v, const std::string& where) {
  Pose pose = Pose::Identity();
  pose.matrix().topRows<3>() =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(v.data());
  const Eigen::Matrix3d r = pose.linear();
  const double error = (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kRotationTolerance) || r.determinant() < 0.0)
    throw InputError(where + ": the 3 x 3 part of the matrix is not a rotation");
  return normalized(pose);
}

}  // namespace

Eigen::Matrix3d R_camera_lidar() {
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return axes;
}

std::string tum_line(const StampedPose& stamped) {
  const Eigen::Quaterniond q(stamped.pose.linear());
  const Eigen::Vector3d t = stamped.pose.translation();
  std::string line = to_seconds(stamped.stamp_ns);
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    line += " " + to_fixed(value, 9);
  return line + "\n";
}

std::string kitti_line(const Pose& pose) {
  std::string line;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      line += (line.empty() ? "" : " ") + to_fixed(pose.matrix()(row, column), 9);
  return line + "\n";
}

void write_tum(const std::filesystem::path& path, const Trajectory& trajectory) {
  AtomicFile file(path);
  for (const StampedPose& pose : trajectory) file.write(tum_line(pose));
  file.commit();
}

void write_kitti(const std::filesystem::path& path, const Trajectory& trajectory,
                 const std::optional<Pose>& T_camera_lidar) {
  const Pose to_camera = T_camera_lidar.value_or(Pose::Identity());
  const Pose from_camera = to_camera.inverse();
  AtomicFile file(path);
  for (const StampedPose& stamped : trajectory)
    file.write(kitti_line(to_camera * stamped.pose * from_camera));
  file.commit();
}

PoseFile read_poses(const std::filesystem::path& path) {
  return parse_poses(read_file(path), path.string());
}

PoseFile parse_poses(std::string_view text, const std::string& file) {
  PoseFile result;
  std::size_t columns = 0;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view whole = take_line(text);
    const std::string_view line = whole.substr(0, whole.find('#'));
    const std::string where = file + ", line " + std::to_string(number);
    Numbers numbers{};
    const std::size_t count = parse_numbers(line, numbers, where);
    if (count == 0) continue;
    if ((count != kTumColumns && count != kKittiColumns) || (columns != 0 && count != columns))
      throw InputError(where + ": " + std::to_string(count) + " columns; every pose needs " +
                       (columns == 0 ? "8 (TUM) or 12 (KITTI)"
                                     : std::to_string(columns) + ", as the first has"));
    columns = count;
    if (columns == kTumColumns)
      result.poses.push_back({parse_stamp(line, where), pose_from_tum(numbers, where)});
    else
      result.poses.push_back(
          {static_cast<std::int64_t>(result.poses.size()), pose_from_kitti(numbers, where)});
  }
  if (result.poses.empty())
    throw InputError(file + " contains no pose; it must be a TUM or KITTI trajectory");
  result.has_stamps = columns == kTumColumns;
  return result;
}

Trajectory read_route(const std::filesystem::path& path) {
  PoseFile file = read_poses(path);
  if (!file.has_stamps) {
    const Eigen::Matrix3d axes = R_camera_lidar();
    for (StampedPose& stamped : file.poses) {
      stamped.stamp_ns *= 100'000'000;
      stamped.pose.translation() = axes.transpose() * stamped.pose.translation();
      stamped.pose.linear() = axes.transpose() * stamped.pose.linear() * axes;
    }
  }
  return std::move(file.poses);
}

}  // namespace lego_loam_sc
