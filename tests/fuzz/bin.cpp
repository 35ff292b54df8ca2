// SPDX-License-Identifier: BSD-3-Clause
#include "io/bin.hpp"

#include "fuzz.hpp"
#include "io/sensor_yaml.hpp"
#include "sensor/recognise_sensor.hpp"

using namespace lego_loam_sc;

int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string bytes = text_of(data, size);
  read_or_refuse([&] {
    const Scan scan = parse_bin(bytes, "file");
    require_whole(scan);
    require(scan.size() * 16 == size);
    static const SensorModel sensor = load_sensor("kitti");
    sensor_mismatch(scan, sensor);
  });
  return 0;
}
