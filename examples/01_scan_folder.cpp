// SPDX-License-Identifier: BSD-3-Clause
//
// Trajectory and map of a folder of scans:
//
//   01_scan_folder SCANS     writes trajectory.tum and map.ply

#include <cstdio>
#include <exception>
#include <lego_loam_sc/io/cloud_writer.hpp>
#include <lego_loam_sc/io/scan_source.hpp>
#include <lego_loam_sc/io/settings_yaml.hpp>
#include <lego_loam_sc/io/trajectory.hpp>
#include <lego_loam_sc/key_frames/map_cloud.hpp>
#include <lego_loam_sc/sensor/recognise_sensor.hpp>
#include <lego_loam_sc/slam/slam.hpp>
#include <optional>
#include <stdexcept>

using namespace lego_loam_sc;

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fputs("usage: 01_scan_folder SCANS\n", stderr);
    return 2;
  }
  // KITTI sequences, folders of .bin, .pcd or .ply files, scan streams.
  const auto source = open_scans(argv[1]);
  std::optional<Scan> scan = source->next();
  if (!scan) throw std::runtime_error("there is no scan");

  // Or load_sensor("vlp16"), or a SensorModel that you fill in.
  const SensorModel sensor = recognise_sensor(*scan, source->facts());
  const Settings settings = load_settings("lego-loam-sc", std::nullopt, {});

  Slam slam(sensor, settings, 2);
  for (; scan; scan = source->next()) {
    const ScanReport report = slam.process(*scan);
    for (const LoopReport& loop : report.loops)
      std::printf("scan %d sees the place of scan %d: %s\n", loop.query_scan, loop.match_scan,
                  to_string(loop.verification.verdict).data());
  }

  write_tum("trajectory.tum", slam.trajectory());
  const auto map =
      make_map(slam.key_frames(), slam.graph().poses(), settings.output.map_voxel_size);
  write_ply("map.ply", map);
  std::printf("%zu poses, %zu points in the map\n", slam.trajectory().size(), map.size());
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
