// SPDX-License-Identifier: BSD-3-Clause
#include "io/dataset_facts.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/atomic_file.hpp"
#include "io/file.hpp"
#include "io/yaml.hpp"

namespace lego_loam_sc {
namespace {

constexpr const char* kFileName = "dataset.yaml";
constexpr std::array<const char*, 5> kUnits = {"s", "ms", "us", "ns", "none"};  // as TimeUnit

TimeUnit to_unit(const YamlEntry& entry) {
  for (std::size_t i = 0; i < kUnits.size(); ++i)
    if (to_string(entry) == kUnits[i]) return static_cast<TimeUnit>(i);
  throw InputError(entry.where + ": " + entry.key + " is " + to_string(entry) +
                   ", it must be s, ms, us, ns or none");
}

}  // namespace

std::optional<Pose> parse_calibration(std::string_view text, const std::string& file) {
  while (!text.empty()) {
    std::string_view line = take_line(text);
    if (take_word(line) != "Tr:") continue;
    Pose pose = Pose::Identity();
    for (int i = 0; i < 12; ++i) {
      const auto value = parse_double(take_word(line));
      if (!value || !std::isfinite(*value))
        throw InputError(file + ": Tr must be 12 numbers, the rows of [R t]");
      pose.matrix()(i / 4, i % 4) = *value;
    }
    if (!pose.linear().isUnitary(1e-3))
      throw InputError(file + ": the 3 x 3 part of Tr is not a rotation");
    return normalized(pose);
  }
  return std::nullopt;
}

DatasetFacts parse_dataset_yaml(const std::string& text, const std::string& file) {
  static const std::vector<std::string> kKeys = {"sensor", "motion_compensated",
                                                 "elevation_correction_deg", "point_times"};
  DatasetFacts facts;
  for (const YamlEntry& entry : parse_yaml(text, file)) {
    if (entry.key == kKeys[0]) {
      facts.sensor = to_string(entry);
    } else if (entry.key == kKeys[1]) {
      facts.motion_compensated = to_bool(entry);
    } else if (entry.key == kKeys[2]) {
      facts.elevation_correction_deg = to_double(entry, -5.0, 5.0);
    } else if (entry.key == kKeys[3]) {
      facts.point_times = to_unit(entry);
    } else {
      fail_unknown_key(entry, kKeys);
    }
  }
  return facts;
}

std::string to_yaml(const DatasetFacts& facts) {
  std::string text;
  if (facts.sensor) text += "sensor: " + *facts.sensor + "\n";
  if (facts.motion_compensated)
    text +=
        std::string("motion_compensated: ") + (*facts.motion_compensated ? "true" : "false") + "\n";
  if (facts.elevation_correction_deg)
    text += "elevation_correction_deg: " + to_text(*facts.elevation_correction_deg) + "\n";
  if (facts.point_times)
    text +=
        std::string("point_times: ") + kUnits[static_cast<std::size_t>(*facts.point_times)] + "\n";
  return text;
}

void write_dataset_yaml(const std::filesystem::path& folder, const DatasetFacts& facts) {
  write_file(folder / kFileName, to_yaml(facts));
}

DatasetFacts read_dataset_facts(const std::filesystem::path& folder) {
  DatasetFacts facts;
  std::error_code missing;
  const std::filesystem::path yaml = folder / kFileName;
  if (std::filesystem::exists(yaml, missing))
    facts = parse_dataset_yaml(read_file(yaml), yaml.string());
  const std::filesystem::path calibration = folder / "calib.txt";
  if (std::filesystem::exists(calibration, missing))
    facts.T_camera_lidar = parse_calibration(read_file(calibration), calibration.string());
  return facts;
}

SensorModel with_facts(SensorModel sensor, const DatasetFacts& facts) {
  sensor.motion_compensated = facts.motion_compensated.value_or(sensor.motion_compensated);
  // Points of explicitly raw sweeps get missing times from the azimuth.
  sensor.times_from_azimuth = facts.motion_compensated.has_value() && !sensor.motion_compensated;
  sensor.elevation_correction_deg =
      facts.elevation_correction_deg.value_or(sensor.elevation_correction_deg);
  return sensor;
}

}  // namespace lego_loam_sc
