// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "io/dataset_facts.hpp"

namespace lego_loam_sc {

/// All presets of config/sensors, in alphabetical order.
std::vector<SensorModel> sensor_presets();

/// The sensor that made `scan`, with the facts applied: the one that the data set names, or else
/// the preset that fits, see sensor/recognise_sensor.hpp. Throws InputError when none fits.
SensorModel recognise_sensor(const Scan& scan, const DatasetFacts& facts);

}  // namespace lego_loam_sc
