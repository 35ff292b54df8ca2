// SPDX-License-Identifier: BSD-3-Clause
#include "io/trajectory.hpp"

#include "fuzz.hpp"
#include "io/dataset_facts.hpp"
#include "io/scan_source.hpp"

using namespace lego_loam_sc;

// The lines of numbers: TUM and KITTI poses, times.txt and calib.txt.
int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string text = text_of(data, size);
  read_or_refuse([&] {
    std::string copy;
    const PoseFile file = parse_poses(text, "file");
    for (const StampedPose& pose : file.poses) {
      require(pose.pose.matrix().allFinite());
      copy += tum_line(pose);
    }
    require(parse_poses(copy, "copy").poses.size() == file.poses.size());
  });
  read_or_refuse([&] { parse_scan_times(text, "file"); });
  read_or_refuse([&] {
    if (const auto pose = parse_calibration(text, "file")) require(pose->matrix().allFinite());
  });
  return 0;
}
