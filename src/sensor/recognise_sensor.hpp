// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "io/dataset_facts.hpp"

namespace lego_loam_sc {

/// A preset and how far its beams are from those of a sensor.
struct NearestPreset {
  std::string name;
  double difference_deg;  ///< of the beams, on average
};

/// The preset whose beams are nearest to these (ascending, deg), a few of which may be missing;
/// nothing when all are more than half a degree off on average.
std::optional<NearestPreset> nearest_preset(const std::vector<double>& elevation_deg);

/// The sensor that made `scan`, with the facts applied: the one that the data set names, or else
/// what the scan shows. Unnumbered points stored ring by ring in 64 rings are KITTI's; otherwise
/// the elevations of the points must lie on the beams of a preset, or numbered rings be near them.
/// An RS-LiDAR-16 has the beams of a VLP-16 and is taken for one. Throws InputError that says what
/// was seen when nothing fits, and why when the points have no beams.
SensorModel recognise_sensor(const Scan& scan, const DatasetFacts& facts);

/// Why `scan` cannot be of `sensor`, as one sentence; nothing when it can.
std::optional<std::string> sensor_mismatch(const Scan& scan, const SensorModel& sensor);

}  // namespace lego_loam_sc
