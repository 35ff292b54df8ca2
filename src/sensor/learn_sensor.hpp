// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"

namespace lego_loam_sc {

/// A sensor as its scans show it, and a sentence for each thing that was found or could not be.
struct LearnedSensor {
  SensorModel sensor;
  std::vector<std::string> notes;
};

/// Finds the beams (by ring numbers, else by KITTI's order of storage, else by the elevations), the
/// columns, the nearest range and, from the times of points, the direction and start of a sweep;
/// what scans do not show keeps its default. Throws InputError that says what was seen when the
/// points lie on no beams, as those of a sensor do that does not spin.
LearnedSensor learn_sensor(std::span<const Scan> scans);

}  // namespace lego_loam_sc
