// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "fuzz.hpp"
#include "io/point_times.hpp"
#include "io/sensor_yaml.hpp"
#include "sensor/recognise_sensor.hpp"

namespace lego_loam_sc {

/// The way of a point file's content up to the SLAM.
inline void follow(RawScan raw) {
  require(raw.time.empty() || raw.time.size() == raw.scan.size());
  for (const bool certain : {false, true}) {
    const StampHint hint{1'600'000'000'000'000'000, certain, std::nullopt};
    read_or_refuse([&] {
      PointTimes times = interpret_point_times(raw.time, raw.time_type, hint, "file");
      raw.scan.offset_ns = std::move(times.offset_ns);
    });
    require_whole(raw.scan);
  }
  static const SensorModel sensor = load_sensor("vlp16");
  sensor_mismatch(raw.scan, sensor);
}

}  // namespace lego_loam_sc
