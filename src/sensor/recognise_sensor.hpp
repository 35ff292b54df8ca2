// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"

namespace lego_loam_sc {

/// A preset and the mean difference of its beams from those of a sensor.
struct NearestPreset {
  std::string name;
  double difference_deg;
};

/// The preset whose beams are nearest to these (ascending, deg), a few of which may be missing;
/// nothing when all presets differ by more than half a degree on average.
std::optional<NearestPreset> nearest_preset(const std::vector<double>& elevation_deg,
                                            std::span<const SensorModel> presets);

/// The preset that fits `scan`. Points without ring numbers that are stored ring by ring in 64
/// rings are KITTI's; otherwise the elevations of the points must lie on the beams of a preset, or
/// the mean elevation of each numbered ring close to one. An RS-LiDAR-16 has the beams of a VLP-16
/// and is recognised as one. Throws InputError that describes the scan when no preset fits, and the
/// reason when the points lie on no beams. io/sensor_presets.hpp has the presets.
SensorModel recognise_sensor(const Scan& scan, std::span<const SensorModel> presets);

/// Why `scan` cannot come from `sensor`, as one sentence; nothing when it can.
std::optional<std::string> sensor_mismatch(const Scan& scan, const SensorModel& sensor);

}  // namespace lego_loam_sc
