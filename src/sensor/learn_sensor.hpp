// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"

namespace lego_loam_sc {

/// A sensor model estimated from scans, and a sentence for each property that was or was not found.
struct LearnedSensor {
  SensorModel sensor;
  std::vector<std::string> notes;
};

/// Finds the beams (by ring numbers, else by KITTI's storage order, else by the elevations), the
/// columns, the minimum range and, from the times of points, the direction and start of a sweep;
/// what scans do not show keeps its default. A note names the nearest of the `presets`. Throws
/// InputError that describes the scans when the points lie on no beams, as with a sensor that does
/// not spin.
LearnedSensor learn_sensor(std::span<const Scan> scans, std::span<const SensorModel> presets);

}  // namespace lego_loam_sc
